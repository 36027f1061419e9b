within UrdfSync.Icons;

partial model Bench "Icon of test benches for robots"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-150, -150}, {150, -110}}, textColor={0, 0, 255}, textString="%name"),
        Rectangle(extent={{-100, -100}, {100, 100}}, lineColor={110, 110, 110}, lineThickness=0.5,
            fillColor={250, 250, 250}, fillPattern=FillPattern.Solid, radius=14),
        Rectangle(extent={{-84, 34}, {-18, 84}}, lineColor={44, 82, 130}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid, radius=4),
        Line(points={{-76, 46}, {-66, 46}, {-58, 50}, {-50, 62}, {-42, 72}, {-34, 74}, {-26, 74}}, color={186, 98, 20},
            thickness=0.75),
        Line(points={{-51, 34}, {-51, -21}, {-24, -21}}, color={44, 82, 130}, thickness=0.5),
        Polygon(points={{-14, -21}, {-26, -14}, {-26, -28}, {-14, -21}}, pattern=LinePattern.None,
            fillColor={44, 82, 130}, fillPattern=FillPattern.Solid),
        Rectangle(extent={{-84, -52}, {84, -42}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{-73, -86}, {-63, -52}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{63, -86}, {73, -52}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{-14, -42}, {26, -30}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Polygon(points={{44, 11}, {47, 5}, {50, 7}, {59, -8}, {63, -5}, {54, 9}, {64, 16}, {74, 2}, {78, 4}, {68, 19},
            {71, 20}, {68, 26}, {44, 11}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Polygon(points={{52, 12}, {54, 9}, {58, 8}, {61, 10}, {64, 12}, {64, 16}, {63, 19}, {45, 49}, {42, 51},
            {38, 52}, {35, 51}, {33, 48}, {32, 45}, {33, 41}, {52, 12}}, lineColor={44, 82, 130}, lineThickness=0.5,
            fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Polygon(points={{41, 39}, {44, 41}, {46, 44}, {45, 48}, {43, 51}, {40, 52}, {36, 52}, {-14, 33}, {-17, 31},
            {-18, 28}, {-18, 24}, {-16, 21}, {-12, 19}, {-9, 20}, {41, 39}}, lineColor={44, 82, 130}, lineThickness=0.5,
            fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Polygon(points={{-5, 29}, {-7, 32}, {-10, 33}, {-14, 33}, {-17, 31}, {-18, 28}, {-18, 24}, {-1, -24}, {1, -27},
            {5, -29}, {8, -29}, {11, -27}, {13, -23}, {13, -20}, {-5, 29}}, lineColor={44, 82, 130}, lineThickness=0.5,
            fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-3, -31}, {15, -13}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-20, 18}, {-2, 35}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{30, 36}, {48, 54}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{3, -25}, {9, -19}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-14, 23}, {-8, 30}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{35, 42}, {42, 48}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
An arm on a table, and the signals that drive it.
</p>
</html>"));
end Bench;
