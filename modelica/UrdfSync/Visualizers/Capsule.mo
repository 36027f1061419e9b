within UrdfSync.Visualizers;

model Capsule "Cylinder with half spheres at both ends"
  extends UrdfSync.Visualizers.PartialShape;

  parameter UrdfSync.Records.Capsule parameters
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

  Modelica.Mechanics.MultiBody.Visualizers.Advanced.Shape lowerEnd(
    shapeType = "sphere",
    length = 2*parameters.radius,
    width = 2*parameters.radius,
    height = 2*parameters.radius,
    lengthDirection = R[:, 3],
    widthDirection = R[:, 1],
    r_shape = parameters.origin.xyz - 0.5*parameters.length*R[:, 3] - parameters.radius*R[:, 3],
    color = parameters.color,
    r = frame_a.r_0,
    R = frame_a.R) if world.enableAnimation and animation
    "Sphere at the lower end";

  Modelica.Mechanics.MultiBody.Visualizers.Advanced.Shape upperEnd(
    shapeType = "sphere",
    length = 2*parameters.radius,
    width = 2*parameters.radius,
    height = 2*parameters.radius,
    lengthDirection = R[:, 3],
    widthDirection = R[:, 1],
    r_shape = parameters.origin.xyz + 0.5*parameters.length*R[:, 3] - parameters.radius*R[:, 3],
    color = parameters.color,
    r = frame_a.r_0,
    R = frame_a.R) if world.enableAnimation and animation
    "Sphere at the upper end";

  annotation (Documentation(info="<html>
<p>
A capsule along z, centred at the origin of its record.
</p>
</html>"));
end Capsule;
