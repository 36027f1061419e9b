within UrdfSync.Icons;

partial model Contact "Icon of contacts with the ground"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-150, 70}, {150, 110}}, textColor={0, 0, 255}, textString="%name"),
        Line(points={{-100, 0}, {0, 0}}, color={90, 90, 90}, thickness=0.5),
        Line(points={{-84, -50}, {84, -50}}, color={90, 90, 90}, thickness=0.75),
        Line(points={{-70, -50}, {-80, -60}}, color={90, 90, 90}),
        Line(points={{-56, -50}, {-66, -60}}, color={90, 90, 90}),
        Line(points={{-42, -50}, {-52, -60}}, color={90, 90, 90}),
        Line(points={{-28, -50}, {-38, -60}}, color={90, 90, 90}),
        Line(points={{-14, -50}, {-24, -60}}, color={90, 90, 90}),
        Line(points={{0, -50}, {-10, -60}}, color={90, 90, 90}),
        Line(points={{14, -50}, {4, -60}}, color={90, 90, 90}),
        Line(points={{28, -50}, {18, -60}}, color={90, 90, 90}),
        Line(points={{42, -50}, {32, -60}}, color={90, 90, 90}),
        Line(points={{56, -50}, {46, -60}}, color={90, 90, 90}),
        Line(points={{70, -50}, {60, -60}}, color={90, 90, 90}),
        Line(points={{84, -50}, {74, -60}}, color={90, 90, 90}),
        Ellipse(extent={{-50, -50}, {50, 50}}, lineColor={44, 82, 130}, lineThickness=0.5, fillColor={200, 217, 240},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-11, -11}, {11, 11}}, lineColor={44, 82, 130}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid),
        Polygon(points={{0, -14}, {-10, -30}, {-3, -30}, {-3, -50}, {3, -50}, {3, -30}, {10, -30}, {0, -14}},
            pattern=LinePattern.None, fillColor={160, 60, 50}, fillPattern=FillPattern.Solid),
        Polygon(points={{62, -47}, {46, -37}, {46, -44}, {0, -44}, {0, -50}, {46, -50}, {46, -57}, {62, -47}},
            pattern=LinePattern.None, fillColor={160, 60, 50}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A wheel on the ground, and the forces at the place where they touch.
</p>
</html>"));
end Contact;
