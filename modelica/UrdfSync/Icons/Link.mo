within UrdfSync.Icons;

partial model Link "Icon of robot links"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-130, -150}, {130, -110}}, textColor={0, 0, 255}, textString="%name"),
        Polygon(points={{-27, 22}, {-31, 27}, {-36, 31}, {-42, 35}, {-48, 37}, {-55, 38}, {-61, 38}, {-68, 37},
            {-74, 34}, {-80, 31}, {-85, 27}, {-89, 22}, {-92, 16}, {-95, 10}, {-96, 3}, {-96, -3}, {-95, -10},
            {-92, -16}, {-89, -22}, {-85, -27}, {-80, -31}, {-74, -34}, {-68, -37}, {-61, -38}, {-55, -38}, {-48, -37},
            {-42, -35}, {-36, -31}, {-31, -27}, {-27, -22}, {27, -22}, {31, -27}, {36, -31}, {42, -35}, {48, -37},
            {55, -38}, {61, -38}, {68, -37}, {74, -34}, {80, -31}, {85, -27}, {89, -22}, {92, -16}, {95, -10}, {96, -3},
            {96, 3}, {95, 10}, {92, 16}, {89, 22}, {85, 27}, {80, 31}, {74, 34}, {68, 37}, {61, 38}, {55, 38}, {48, 37},
            {42, 35}, {36, 31}, {31, 27}, {27, 22}, {-27, 22}}, lineColor={44, 82, 130}, lineThickness=0.5,
            fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-73, -15}, {-43, 15}}, lineColor={44, 82, 130}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{43, -15}, {73, 15}}, lineColor={44, 82, 130}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-15, -15}, {15, 15}}, lineColor={44, 82, 130}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid),
        Polygon(points={{0, 0}, {15, 0}, {14, 4}, {13, 7}, {11, 11}, {8, 13}, {4, 14}, {0, 15}, {0, 0}},
            pattern=LinePattern.None, fillColor={44, 82, 130}, fillPattern=FillPattern.Solid),
        Polygon(points={{0, 0}, {-15, 0}, {-14, -4}, {-13, -8}, {-11, -11}, {-8, -13}, {-4, -14}, {0, -15}, {0, 0}},
            pattern=LinePattern.None, fillColor={44, 82, 130}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A rigid body with its joints at both ends and the mark of the centre of mass. The name stands below it; between
y = -100 and y = -60 there is room for the mass.
</p>
</html>"));
end Link;
