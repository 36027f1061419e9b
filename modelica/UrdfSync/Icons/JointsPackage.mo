within UrdfSync.Icons;

partial package JointsPackage "Icon of packages of joints"
  extends Modelica.Icons.Package;

  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Polygon(points={{-66, -38}, {-71, -44}, {-72, -51}, {-70, -58}, {-64, -63}, {-57, -64}, {-50, -62}, {8, -22},
            {13, -16}, {14, -9}, {12, -2}, {6, 3}, {-1, 4}, {-8, 2}, {-66, -38}}, lineColor={90, 90, 90},
            lineThickness=0.5, fillColor={224, 224, 224}, fillPattern=FillPattern.Solid),
        Polygon(points={{71, 1}, {77, 5}, {80, 12}, {79, 19}, {75, 25}, {68, 28}, {61, 27}, {-5, 3}, {-11, -1},
            {-14, -8}, {-13, -15}, {-9, -21}, {-2, -24}, {5, -23}, {71, 1}}, lineColor={186, 98, 20}, lineThickness=0.5,
            fillColor={253, 226, 196}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-30, -40}, {30, 20}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-10, -20}, {10, 0}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid),
        Polygon(points={{28, 53}, {17, 57}, {6, 59}, {-6, 59}, {-18, 57}, {-29, 53}, {-39, 47}, {-48, 39}, {-54, 45},
            {-57, 23}, {-38, 29}, {-44, 35}, {-36, 42}, {-26, 47}, {-16, 51}, {-6, 53}, {5, 53}, {16, 51}, {26, 47},
            {23, 40}, {42, 41}, {32, 60}, {28, 53}}, pattern=LinePattern.None, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A pivot.
</p>
</html>"));
end JointsPackage;
