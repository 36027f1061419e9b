within UrdfSync.Icons;

partial model Coupling "Icon of couplings between joints"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-130, 70}, {130, 110}}, textColor={0, 0, 255}, textString="%name"),
        Line(points={{-100, 0}, {-32, 0}}, color={90, 90, 90}, thickness=0.5),
        Line(points={{38, 0}, {100, 0}}, color={90, 90, 90}, thickness=0.5),
        Polygon(points={{9, -6}, {18, -4}, {18, 4}, {9, 6}, {7, 13}, {14, 19}, {11, 25}, {2, 22}, {-4, 28}, {-1, 37},
            {-7, 40}, {-13, 33}, {-20, 35}, {-22, 44}, {-30, 44}, {-32, 35}, {-39, 33}, {-45, 40}, {-51, 37}, {-48, 28},
            {-54, 22}, {-63, 25}, {-66, 19}, {-59, 13}, {-61, 6}, {-70, 4}, {-70, -4}, {-61, -6}, {-59, -13},
            {-66, -19}, {-63, -25}, {-54, -22}, {-48, -28}, {-51, -37}, {-45, -40}, {-39, -33}, {-32, -35}, {-30, -44},
            {-22, -44}, {-20, -35}, {-13, -33}, {-7, -40}, {-1, -37}, {-4, -28}, {2, -22}, {11, -25}, {14, -19},
            {7, -13}, {9, -6}}, lineColor={135, 110, 35}, lineThickness=0.5, fillColor={246, 236, 200},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-36, -10}, {-16, 10}}, lineColor={135, 110, 35}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid),
        Polygon(points={{20, -3}, {12, -8}, {15, -15}, {24, -13}, {28, -17}, {26, -26}, {33, -29}, {38, -21}, {44, -21},
            {49, -29}, {56, -26}, {54, -17}, {58, -13}, {67, -15}, {70, -8}, {62, -3}, {62, 3}, {70, 8}, {67, 15},
            {58, 13}, {54, 17}, {56, 26}, {49, 29}, {44, 21}, {38, 21}, {33, 29}, {26, 26}, {28, 17}, {24, 13},
            {15, 15}, {12, 8}, {20, 3}, {20, -3}}, lineColor={135, 110, 35}, lineThickness=0.5,
            fillColor={246, 236, 200}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{34, -7}, {48, 7}}, lineColor={135, 110, 35}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid),
        Polygon(points={{-38, 47}, {-27, 54}, {-14, 58}, {-1, 61}, {13, 61}, {26, 59}, {28, 66}, {42, 49}, {22, 45},
            {24, 53}, {12, 55}, {0, 55}, {-12, 53}, {-24, 49}, {-35, 43}, {-38, 47}}, pattern=LinePattern.None,
            fillColor={135, 110, 35}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
Two gears that mesh; the arrow leads from the axis that is followed to the axis that follows.
</p>
</html>"));
end Coupling;
