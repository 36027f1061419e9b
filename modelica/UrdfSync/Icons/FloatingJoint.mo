within UrdfSync.Icons;

partial model FloatingJoint "Icon of floating joints"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-130, -110}, {130, -70}}, textColor={0, 0, 255}, textString="%name"),
        Rectangle(extent={{-100, -12}, {-78, 12}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{-78, -40}, {-66, 40}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Line(points={{-66, 0}, {-28, 0}}, color={0, 115, 125}, thickness=0.5, pattern=LinePattern.Dash),
        Rectangle(extent={{60, -12}, {100, 12}}, lineColor={0, 115, 125}, fillColor={204, 236, 238},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-26, -50}, {74, 50}}, lineColor={0, 115, 125}, lineThickness=0.5, fillColor={204, 236, 238},
            fillPattern=FillPattern.Solid),
        Polygon(points={{24, 40}, {16, 27}, {22, 27}, {22, 0}, {26, 0}, {26, 27}, {32, 27}, {24, 40}},
            pattern=LinePattern.None, fillColor={0, 115, 125}, fillPattern=FillPattern.Solid),
        Polygon(points={{59, -20}, {51, -7}, {48, -12}, {25, 2}, {23, -2}, {46, -15}, {43, -20}, {59, -20}},
            pattern=LinePattern.None, fillColor={0, 115, 125}, fillPattern=FillPattern.Solid),
        Polygon(points={{-11, -20}, {5, -20}, {2, -15}, {25, -2}, {23, 2}, {0, -12}, {-3, -7}, {-11, -20}},
            pattern=LinePattern.None, fillColor={0, 115, 125}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A body that nothing holds: it moves along and about all three axes.
</p>
</html>"));
end FloatingJoint;
