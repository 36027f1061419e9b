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

  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Ellipse(extent={{-48, -64}, {78, 62}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-48, -22}, {78, 20}}, lineColor={186, 98, 20}, startAngle=180, endAngle=360,
            closure=EllipseClosure.None),
        Ellipse(extent={{-20, 14}, {8, 42}}, pattern=LinePattern.None, fillColor={255, 243, 228},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A sphere, centred at the origin of its record.
</p>
</html>"));
end Sphere;
