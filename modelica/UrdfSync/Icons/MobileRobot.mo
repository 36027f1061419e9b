within UrdfSync.Icons;

partial model MobileRobot "Icon of robots that move over the ground"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-150, -150}, {150, -110}}, textColor={0, 0, 255}, textString="%name"),
        Rectangle(extent={{-100, -100}, {100, 100}}, lineColor={44, 82, 130}, lineThickness=0.5,
            fillColor={255, 255, 255}, fillPattern=FillPattern.Solid, radius=14),
        Line(points={{-88, -78}, {88, -78}}, color={90, 90, 90}, thickness=0.75),
        Polygon(points={{-74, -44}, {74, -44}, {74, -24}, {58, -10}, {-58, -10}, {-74, -24}, {-74, -44}},
            lineColor={90, 90, 90}, lineThickness=0.5, fillColor={224, 224, 224}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-68, -78}, {-20, -30}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={200, 200, 200},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-52, -62}, {-36, -46}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{20, -78}, {68, -30}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={200, 200, 200},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{36, -62}, {52, -46}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid),
        Polygon(points={{17, 36}, {21, 30}, {24, 32}, {34, 16}, {38, 18}, {28, 34}, {40, 42}, {50, 26}, {54, 28},
            {44, 44}, {47, 46}, {43, 52}, {17, 36}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Polygon(points={{26, 37}, {29, 34}, {32, 33}, {36, 34}, {39, 37}, {40, 41}, {39, 45}, {18, 77}, {15, 80},
            {11, 81}, {8, 80}, {5, 77}, {4, 73}, {5, 69}, {26, 37}}, lineColor={44, 82, 130}, lineThickness=0.5,
            fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Polygon(points={{14, 66}, {18, 68}, {19, 72}, {19, 76}, {17, 79}, {13, 81}, {9, 80}, {-45, 60}, {-49, 58},
            {-50, 54}, {-50, 50}, {-48, 47}, {-44, 45}, {-40, 46}, {14, 66}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Polygon(points={{-35, 55}, {-38, 59}, {-41, 60}, {-45, 60}, {-49, 58}, {-50, 54}, {-50, 50}, {-31, -3},
            {-29, -6}, {-25, -8}, {-21, -7}, {-18, -5}, {-16, -1}, {-17, 3}, {-35, 55}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-34, -10}, {-14, 10}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-52, 43}, {-33, 62}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{2, 64}, {21, 83}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-28, -4}, {-20, 4}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-46, 49}, {-39, 56}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{8, 70}, {15, 77}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
An arm on a platform with wheels. A robot model may continue the icon above y = 100, for the connectors of its
drives; the name stands below.
</p>
</html>"));
end MobileRobot;
