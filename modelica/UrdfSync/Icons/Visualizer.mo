within UrdfSync.Icons;

partial model Visualizer "Icon of shapes in the animation"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-150, 70}, {150, 110}}, textColor={0, 0, 255}, textString="%name"),
        Line(points={{-100, 0}, {-52, 0}}, color={90, 90, 90}, thickness=0.5),
        Rectangle(extent={{6, -2}, {58, 50}}, pattern=LinePattern.None, fillColor={205, 235, 213},
            fillPattern=FillPattern.Solid),
        Line(points={{6, 50}, {6, -2}}, color={38, 115, 65}, thickness=0.5),
        Line(points={{58, 50}, {58, -2}}, color={38, 115, 65}, thickness=0.5),
        Ellipse(extent={{6, 41}, {58, 59}}, lineColor={38, 115, 65}, lineThickness=0.5, fillColor={232, 246, 236},
            fillPattern=FillPattern.Solid),
        Polygon(points={{-22, -10}, {-53, 8}, {-22, 26}, {9, 8}, {-22, -10}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={226, 236, 248}, fillPattern=FillPattern.Solid),
        Polygon(points={{-22, -10}, {-53, 8}, {-53, -28}, {-22, -46}, {-22, -10}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Polygon(points={{-22, -10}, {9, 8}, {9, -28}, {-22, -46}, {-22, -10}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={160, 186, 222}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{20, -52}, {80, 8}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{34, -19}, {48, -5}}, pattern=LinePattern.None, fillColor={255, 243, 228},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A box, a cylinder and a sphere.
</p>
</html>"));
end Visualizer;
