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

  annotation (Documentation(info="<html>
<p>
A file with numbers in metres, drawn as it is. Which formats are shown depends on the tool; STL and OBJ are widely known.
A tool that does not find a file must not stop for it: leave the mesh out by <code>animation = false</code>.
</p>
</html>"));
end Mesh;
