within UrdfSync.Visualizers;

model Mesh "Shape from a file"
  extends UrdfSync.Visualizers.PartialShape;

  parameter UrdfSync.Records.Mesh parameters
    "Place, colour and size";

protected
  final parameter Real R[3, 3] = UrdfSync.Functions.rotation(parameters.origin.rpy)
    "Axes of the shape frame as columns, resolved in frame_a";

  Modelica.Mechanics.MultiBody.Visualizers.Advanced.Shape shape(
    shapeType = parameters.uri,
    length = 1,
    width = 1,
    height = 1,
    lengthDirection = R[:, 1],
    widthDirection = R[:, 2],
    r_shape = parameters.origin.xyz,
    color = parameters.color,
    r = frame_a.r_0,
    R = frame_a.R) if world.enableAnimation and animation
    "Mesh";

  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Polygon(points={{15, 62}, {-17, 20}, {47, 20}, {15, 62}}, lineColor={105, 70, 150},
            lineThickness=0.5, fillColor={240, 233, 249}, fillPattern=FillPattern.Solid),
        Polygon(points={{15, 62}, {-41, 31}, {-17, 20}, {15, 62}}, lineColor={105, 70, 150},
            lineThickness=0.5, fillColor={240, 233, 249}, fillPattern=FillPattern.Solid),
        Polygon(points={{15, 62}, {47, 20}, {71, 31}, {15, 62}}, lineColor={105, 70, 150},
            lineThickness=0.5, fillColor={228, 217, 243}, fillPattern=FillPattern.Solid),
        Polygon(points={{-41, 31}, {-41, -33}, {-17, 20}, {-41, 31}}, lineColor={105, 70, 150},
            lineThickness=0.5, fillColor={228, 217, 243}, fillPattern=FillPattern.Solid),
        Polygon(points={{-17, 20}, {-41, -33}, {15, -37}, {-17, 20}}, lineColor={105, 70, 150},
            lineThickness=0.5, fillColor={228, 217, 243}, fillPattern=FillPattern.Solid),
        Polygon(points={{-17, 20}, {47, 20}, {15, -37}, {-17, 20}}, lineColor={105, 70, 150},
            lineThickness=0.5, fillColor={240, 233, 249}, fillPattern=FillPattern.Solid),
        Polygon(points={{47, 20}, {71, 31}, {71, -33}, {47, 20}}, lineColor={105, 70, 150},
            lineThickness=0.5, fillColor={205, 186, 230}, fillPattern=FillPattern.Solid),
        Polygon(points={{47, 20}, {71, -33}, {15, -37}, {47, 20}}, lineColor={105, 70, 150},
            lineThickness=0.5, fillColor={205, 186, 230}, fillPattern=FillPattern.Solid),
        Polygon(points={{15, -37}, {-41, -33}, {15, -64}, {15, -37}}, lineColor={105, 70, 150},
            lineThickness=0.5, fillColor={205, 186, 230}, fillPattern=FillPattern.Solid),
        Polygon(points={{15, -37}, {15, -64}, {71, -33}, {15, -37}}, lineColor={105, 70, 150},
            lineThickness=0.5, fillColor={205, 186, 230}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A file with numbers in metres, drawn as it is. Which formats are shown depends on the tool; STL and OBJ are widely known.
A tool that does not find a file must not stop for it: leave the mesh out by <code>animation = false</code>.
</p>
</html>"));
end Mesh;
