within UrdfSync.Icons;

partial model Friction "Icon of friction in joints"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-150, 70}, {150, 110}}, textColor={0, 0, 255}, textString="%name"),
        Line(points={{-100, 0}, {-70, 0}}, color={90, 90, 90}, thickness=0.5),
        Line(points={{100, 0}, {70, 0}}, color={90, 90, 90}, thickness=0.5),
        Line(points={{-70, 34}, {-70, -26}}, color={90, 90, 90}, thickness=0.5),
        Line(points={{70, 34}, {70, -50}}, color={90, 90, 90}, thickness=0.5),
        Rectangle(extent={{-40, 18}, {22, 50}}, pattern=LinePattern.None, fillColor={247, 217, 210},
            fillPattern=FillPattern.Solid),
        Line(points={{22, 50}, {-40, 50}, {-40, 18}, {22, 18}}, color={160, 60, 50}, thickness=0.5),
        Line(points={{-70, 34}, {-40, 34}}, color={90, 90, 90}, thickness=0.5),
        Rectangle(extent={{-10, 22}, {-4, 46}}, lineColor={160, 60, 50}, fillColor={160, 60, 50},
            fillPattern=FillPattern.Solid),
        Line(points={{-4, 34}, {70, 34}}, color={90, 90, 90}, thickness=0.5),
        Line(points={{-70, -26}, {-46, -26}}, color={90, 90, 90}, thickness=0.5),
        Line(points={{70, -50}, {46, -50}}, color={90, 90, 90}, thickness=0.5),
        Polygon(points={{-46, -16}, {30, -16}, {30, -32}, {24, -38}, {18, -32}, {12, -38}, {6, -32}, {0, -38},
            {-6, -32}, {-12, -38}, {-18, -32}, {-24, -38}, {-30, -32}, {-36, -38}, {-46, -32}, {-46, -16}},
            lineColor={160, 60, 50}, lineThickness=0.5, fillColor={247, 217, 210}, fillPattern=FillPattern.Solid),
        Polygon(points={{46, -58}, {-30, -58}, {-30, -41}, {-24, -47}, {-18, -41}, {-12, -47}, {-6, -41}, {0, -47},
            {6, -41}, {12, -47}, {18, -41}, {24, -47}, {30, -41}, {36, -47}, {46, -41}, {46, -58}},
            lineColor={90, 90, 90}, lineThickness=0.5, fillColor={224, 224, 224}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A damper, and below it two rough faces that rub, side by side between two flanges.
</p>
</html>"));
end Friction;
