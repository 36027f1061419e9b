within UrdfSync.Icons;

partial record Parameters "Icon of records with the numbers of a URDF element"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-150, 70}, {150, 110}}, textColor={0, 0, 255}, textString="%name"),
        Rectangle(extent={{-80, -75}, {80, 60}}, lineColor={44, 82, 130}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid, radius=12),
        Polygon(points={{-80, 24}, {-80, 48}, {-78, 54}, {-74, 58}, {-68, 60}, {68, 60}, {74, 58}, {78, 54}, {80, 48},
            {80, 24}, {-80, 24}}, lineColor={44, 82, 130}, lineThickness=0.5, fillColor={200, 217, 240},
            fillPattern=FillPattern.Solid),
        Line(points={{0, 60}, {0, -75}}, color={44, 82, 130}),
        Line(points={{-80, -9}, {80, -9}}, color={44, 82, 130}),
        Line(points={{-80, -42}, {80, -42}}, color={44, 82, 130}),
        Line(points={{-62, 7}, {-22, 7}}, color={110, 110, 110}, thickness=0.75),
        Line(points={{-62, -26}, {-32, -26}}, color={110, 110, 110}, thickness=0.75),
        Line(points={{-62, -59}, {-26, -59}}, color={110, 110, 110}, thickness=0.75),
        Rectangle(extent={{32, 3}, {62, 11}}, pattern=LinePattern.None, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{20, -30}, {62, -22}}, pattern=LinePattern.None, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{42, -63}, {62, -55}}, pattern=LinePattern.None, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A table: names on the left, numbers on the right.
</p>
</html>"));
end Parameters;
