within UrdfSync.Icons;

partial package LinksPackage "Icon of packages of links"
  extends Modelica.Icons.Package;

  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Polygon(points={{-27, 0}, {-32, 0}, {-37, 0}, {-42, 0}, {-47, -2}, {-52, -5}, {-56, -8}, {-59, -12}, {-62, -17},
            {-63, -21}, {-64, -27}, {-64, -32}, {-63, -37}, {-62, -42}, {-59, -46}, {-56, -50}, {-52, -53}, {-47, -56},
            {-42, -58}, {-37, -59}, {-32, -59}, {-27, -58}, {-22, -56}, {-18, -53}, {-14, -50}, {-10, -46}, {-8, -42},
            {-6, -37}, {-5, -32}, {-5, -27}, {27, 0}, {32, 0}, {37, 0}, {42, 0}, {47, 2}, {52, 5}, {56, 8}, {59, 12},
            {62, 17}, {63, 21}, {64, 27}, {64, 32}, {63, 37}, {62, 42}, {59, 46}, {56, 50}, {52, 53}, {47, 56},
            {42, 58}, {37, 59}, {32, 59}, {27, 58}, {22, 56}, {18, 53}, {14, 50}, {10, 46}, {8, 42}, {6, 37}, {5, 32},
            {5, 27}, {-27, 0}}, lineColor={44, 82, 130}, lineThickness=0.5, fillColor={200, 217, 240},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-48, -42}, {-22, -16}}, lineColor={44, 82, 130}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{22, 16}, {48, 42}}, lineColor={44, 82, 130}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A rigid body.
</p>
</html>"));
end LinksPackage;
