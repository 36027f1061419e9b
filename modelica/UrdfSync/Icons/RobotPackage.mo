within UrdfSync.Icons;

partial package RobotPackage "Icon of packages of one robot"
  extends Modelica.Icons.Package;

  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Line(points={{-70, -66}, {70, -66}}, color={90, 90, 90}, thickness=0.75),
        Line(points={{-56, -66}, {-66, -76}}, color={90, 90, 90}),
        Line(points={{-42, -66}, {-52, -76}}, color={90, 90, 90}),
        Line(points={{-28, -66}, {-38, -76}}, color={90, 90, 90}),
        Line(points={{-14, -66}, {-24, -76}}, color={90, 90, 90}),
        Line(points={{0, -66}, {-10, -76}}, color={90, 90, 90}),
        Line(points={{14, -66}, {4, -76}}, color={90, 90, 90}),
        Line(points={{28, -66}, {18, -76}}, color={90, 90, 90}),
        Line(points={{42, -66}, {32, -76}}, color={90, 90, 90}),
        Line(points={{56, -66}, {46, -76}}, color={90, 90, 90}),
        Line(points={{70, -66}, {60, -76}}, color={90, 90, 90}),
        Polygon(points={{-56, -66}, {-2, -66}, {-14, -34}, {-44, -34}, {-56, -66}}, lineColor={90, 90, 90},
            lineThickness=0.5, fillColor={224, 224, 224}, fillPattern=FillPattern.Solid),
        Polygon(points={{22, 16}, {27, 9}, {30, 11}, {42, -9}, {48, -5}, {35, 14}, {50, 23}, {62, 4}, {67, 7}, {55, 27},
            {59, 29}, {54, 36}, {22, 16}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Polygon(points={{32, 17}, {36, 14}, {41, 13}, {45, 14}, {49, 18}, {50, 23}, {48, 27}, {23, 67}, {19, 71},
            {15, 72}, {10, 70}, {7, 67}, {6, 62}, {7, 57}, {32, 17}}, lineColor={44, 82, 130}, lineThickness=0.5,
            fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Polygon(points={{18, 53}, {22, 56}, {24, 61}, {24, 66}, {21, 70}, {17, 72}, {12, 71}, {-55, 46}, {-59, 43},
            {-61, 39}, {-61, 34}, {-58, 30}, {-54, 28}, {-49, 28}, {18, 53}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Polygon(points={{-43, 40}, {-46, 44}, {-50, 46}, {-55, 46}, {-59, 43}, {-61, 39}, {-61, 34}, {-38, -31},
            {-35, -35}, {-31, -37}, {-26, -37}, {-22, -34}, {-20, -30}, {-20, -25}, {-43, 40}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-40, -40}, {-18, -16}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-64, 26}, {-41, 49}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{4, 51}, {27, 74}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-33, -32}, {-25, -24}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-56, 33}, {-48, 41}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{11, 58}, {19, 66}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A robot arm.
</p>
</html>"));
end RobotPackage;
