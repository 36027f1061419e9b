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

  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Rectangle(extent={{-27, -64}, {57, 62}}, lineColor={0, 115, 125}, lineThickness=0.5, fillColor={205, 236, 238},
            fillPattern=FillPattern.Solid, radius=42),
        Ellipse(extent={{-27, 10}, {57, 30}}, lineColor={0, 115, 125}, startAngle=180, endAngle=360,
            closure=EllipseClosure.None),
        Ellipse(extent={{-27, -32}, {57, -12}}, lineColor={0, 115, 125}, startAngle=180, endAngle=360,
            closure=EllipseClosure.None),
        Ellipse(extent={{-8, 32}, {8, 48}}, pattern=LinePattern.None, fillColor={238, 250, 250},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A capsule along z, centred at the origin of its record.
</p>
</html>"));
end Capsule;
