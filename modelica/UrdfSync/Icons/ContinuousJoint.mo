within UrdfSync.Icons;

partial model ContinuousJoint "Icon of continuous joints"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-130, -150}, {130, -110}}, textColor={0, 0, 255}, textString="%name"),
        Line(points={{0, 100}, {0, 30}}, color={110, 110, 110}, thickness=0.5),
        Line(points={{-60, 100}, {-60, 10}}, color={110, 110, 110}, thickness=0.5),
        Rectangle(extent={{-100, -12}, {0, 12}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{0, -12}, {100, 12}}, lineColor={186, 98, 20}, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-30, -30}, {30, 30}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-10, -10}, {10, 10}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid),
        Polygon(points={{-16, 49}, {-24, 45}, {-32, 40}, {-38, 34}, {-43, 27}, {-47, 19}, {-50, 10}, {-51, 1},
            {-50, -8}, {-48, -16}, {-45, -25}, {-40, -32}, {-33, -38}, {-26, -44}, {-18, -48}, {-10, -50}, {-1, -51},
            {8, -50}, {17, -48}, {25, -44}, {33, -39}, {39, -33}, {44, -26}, {48, -18}, {50, -9}, {51, 0}, {50, 9},
            {48, 18}, {44, 26}, {39, 33}, {32, 39}, {38, 46}, {15, 46}, {24, 29}, {29, 35}, {34, 29}, {39, 23},
            {42, 16}, {44, 8}, {45, 0}, {44, -8}, {42, -15}, {39, -23}, {34, -29}, {29, -35}, {22, -39}, {15, -42},
            {7, -44}, {-1, -45}, {-8, -44}, {-16, -42}, {-23, -39}, {-30, -34}, {-35, -28}, {-39, -22}, {-43, -14},
            {-44, -7}, {-45, 1}, {-44, 9}, {-42, 17}, {-38, 24}, {-34, 30}, {-28, 35}, {-21, 40}, {-14, 43}, {-16, 49}},
            pattern=LinePattern.None, fillColor={186, 98, 20}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A pivot with an arrow all around: it turns without end. The axis is driven from the top, between the fixed
support (left) and the part that turns (right). The name stands below, where no connection runs; between y = -100
and y = -60 there is room for a line of text.
</p>
</html>"));
end ContinuousJoint;
