within UrdfSync.Icons;

partial model TranslationalDrive "Icon of drives that move a sliding axis along a sweep"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-150, 80}, {150, 120}}, textColor={0, 0, 255}, textString="%name"),
        Rectangle(extent={{44, -12}, {100, 12}}, lineColor={38, 115, 65}, fillColor={205, 235, 213},
            fillPattern=FillPattern.Solid),
        Line(points={{0, -60}, {0, -100}}, color={90, 90, 90}, thickness=0.5),
        Rectangle(extent={{-90, -60}, {56, 60}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid, radius=8),
        Rectangle(extent={{-78, -48}, {44, 48}}, lineColor={44, 82, 130}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid, radius=4),
        Line(points={{-66, -36}, {34, -36}}, color={160, 160, 160}),
        Line(points={{-62, -40}, {-62, 40}}, color={160, 160, 160}),
        Line(points={{-62, -36}, {-56, -33}, {-50, -26}, {-45, -14}, {-39, -1}, {-33, 12}, {-28, 24}, {-22, 31},
            {-16, 34}, {-10, 31}, {-4, 24}, {1, 12}, {7, -1}, {13, -14}, {18, -26}, {24, -33}, {30, -36}},
            color={38, 115, 65}, thickness=0.75),
        Line(points={{66, 30}, {92, 30}}, color={38, 115, 65}, thickness=0.75),
        Polygon(points={{58, 30}, {70, 23}, {70, 37}, {58, 30}}, pattern=LinePattern.None, fillColor={38, 115, 65},
            fillPattern=FillPattern.Solid),
        Polygon(points={{100, 30}, {88, 23}, {88, 37}, {100, 30}}, pattern=LinePattern.None, fillColor={38, 115, 65},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A motor with the way there and back that it follows. The rod is at the right, the support below.
</p>
</html>"));
end TranslationalDrive;
