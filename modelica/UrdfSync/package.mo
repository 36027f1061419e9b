within ;

package UrdfSync "Robots from URDF files, with multibody parts of the Modelica Standard Library"
  extends Modelica.Icons.Package;

  annotation (
    preferredView="info",
    version="1.0.0",
    uses(Modelica(version="4.0.0")),
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Polygon(points={{-74, 43}, {-66, 56}, {-55, 66}, {-42, 75}, {-28, 81}, {-13, 85}, {2, 86}, {17, 84}, {32, 80},
            {45, 73}, {51, 82}, {63, 53}, {35, 57}, {41, 66}, {29, 73}, {15, 76}, {2, 78}, {-12, 77}, {-26, 74},
            {-38, 68}, {-50, 60}, {-60, 50}, {-68, 39}, {-74, 43}}, pattern=LinePattern.None, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Polygon(points={{74, -43}, {66, -56}, {55, -66}, {42, -75}, {28, -81}, {13, -85}, {-2, -86}, {-17, -84},
            {-32, -80}, {-45, -73}, {-51, -82}, {-63, -53}, {-35, -57}, {-41, -66}, {-29, -73}, {-15, -76}, {-2, -78},
            {12, -77}, {26, -74}, {38, -68}, {50, -60}, {60, -50}, {68, -39}, {74, -43}}, pattern=LinePattern.None,
            fillColor={186, 98, 20}, fillPattern=FillPattern.Solid),
        Polygon(points={{-46, -52}, {-2, -52}, {-12, -24}, {-36, -24}, {-46, -52}}, lineColor={90, 90, 90},
            lineThickness=0.5, fillColor={224, 224, 224}, fillPattern=FillPattern.Solid),
        Polygon(points={{16, 16}, {19, 11}, {22, 12}, {32, -3}, {36, 0}, {26, 15}, {37, 22}, {47, 7}, {51, 9}, {42, 25},
            {44, 26}, {41, 32}, {16, 16}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Polygon(points={{24, 17}, {27, 15}, {30, 14}, {34, 15}, {37, 18}, {37, 22}, {36, 25}, {17, 56}, {14, 59},
            {10, 60}, {6, 59}, {4, 56}, {3, 52}, {4, 49}, {24, 17}}, lineColor={44, 82, 130}, lineThickness=0.5,
            fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Polygon(points={{13, 46}, {16, 48}, {18, 51}, {17, 55}, {15, 58}, {12, 60}, {8, 59}, {-45, 40}, {-48, 38},
            {-49, 34}, {-49, 30}, {-47, 27}, {-43, 26}, {-39, 26}, {13, 46}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Polygon(points={{-35, 35}, {-37, 38}, {-41, 40}, {-45, 40}, {-48, 38}, {-49, 34}, {-49, 30}, {-31, -20},
            {-29, -24}, {-25, -25}, {-22, -25}, {-18, -23}, {-17, -19}, {-17, -16}, {-35, 35}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-33, -27}, {-15, -9}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-51, 24}, {-33, 42}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{1, 43}, {20, 62}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-27, -21}, {-21, -15}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-46, 29}, {-39, 36}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{7, 49}, {14, 56}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
What the packages that <code>urdfsync</code> generates from URDF files are built on: records for the numbers of a URDF,
friction, couplings, functions and icons; and link, joint and robot models that stand alone.
</p>
<p>
Start with the <a href=\"modelica://UrdfSync.UsersGuide\">User's Guide</a> and the
<a href=\"modelica://UrdfSync.Examples\">Examples</a>.
</p>
</html>"));
end UrdfSync;
