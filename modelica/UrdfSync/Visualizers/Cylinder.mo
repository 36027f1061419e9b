within UrdfSync.Visualizers;

model Cylinder "Cylinder"
  extends UrdfSync.Visualizers.PartialShape;

  parameter UrdfSync.Records.Cylinder parameters
    "Place, colour and size";

protected
  final parameter Real R[3, 3] = UrdfSync.Functions.rotation(parameters.origin.rpy)
    "Axes of the shape frame as columns, resolved in frame_a";

  Modelica.Mechanics.MultiBody.Visualizers.Advanced.Shape shape(
    shapeType = "cylinder",
    length = parameters.length,
    width = 2*parameters.radius,
    height = 2*parameters.radius,
    lengthDirection = R[:, 3],
    widthDirection = R[:, 1],
    r_shape = parameters.origin.xyz - 0.5*parameters.length*R[:, 3],
    color = parameters.color,
    r = frame_a.r_0,
    R = frame_a.R) if world.enableAnimation and animation
    "Cylinder";

  annotation (Documentation(info="<html>
<p>
A cylinder along z, centred at the origin of its record.
</p>
</html>"));
end Cylinder;
