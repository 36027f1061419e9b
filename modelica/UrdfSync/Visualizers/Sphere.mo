within UrdfSync.Visualizers;

model Sphere "Sphere"
  extends UrdfSync.Visualizers.PartialShape;

  parameter UrdfSync.Records.Sphere parameters
    "Place, colour and size";

protected
  final parameter Real R[3, 3] = UrdfSync.Functions.rotation(parameters.origin.rpy)
    "Axes of the shape frame as columns, resolved in frame_a";

  Modelica.Mechanics.MultiBody.Visualizers.Advanced.Shape shape(
    shapeType = "sphere",
    length = 2*parameters.radius,
    width = 2*parameters.radius,
    height = 2*parameters.radius,
    lengthDirection = R[:, 3],
    widthDirection = R[:, 1],
    r_shape = parameters.origin.xyz - parameters.radius*R[:, 3],
    color = parameters.color,
    r = frame_a.r_0,
    R = frame_a.R) if world.enableAnimation and animation
    "Sphere";

  annotation (Documentation(info="<html>
<p>
A sphere, centred at the origin of its record.
</p>
</html>"));
end Sphere;
