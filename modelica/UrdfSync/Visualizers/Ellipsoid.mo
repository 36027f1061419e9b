within UrdfSync.Visualizers;

model Ellipsoid "Ellipsoid"
  extends UrdfSync.Visualizers.PartialShape;

  parameter UrdfSync.Records.Ellipsoid parameters
    "Place, colour and size";

protected
  final parameter Real R[3, 3] = UrdfSync.Functions.rotation(parameters.origin.rpy)
    "Axes of the shape frame as columns, resolved in frame_a";

  Modelica.Mechanics.MultiBody.Visualizers.Advanced.Shape shape(
    shapeType = "sphere",
    length = 2*parameters.radii[1],
    width = 2*parameters.radii[2],
    height = 2*parameters.radii[3],
    lengthDirection = R[:, 1],
    widthDirection = R[:, 2],
    r_shape = parameters.origin.xyz - parameters.radii[1]*R[:, 1],
    color = parameters.color,
    r = frame_a.r_0,
    R = frame_a.R) if world.enableAnimation and animation
    "Sphere with three diameters";

  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Ellipse(extent={{-65, -46}, {95, 44}}, lineColor={104, 72, 150}, lineThickness=0.5, fillColor={228, 217, 243},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-65, -16}, {95, 14}}, lineColor={104, 72, 150}, startAngle=180, endAngle=360,
            closure=EllipseClosure.None),
        Ellipse(extent={{-35, 10}, {-3, 30}}, pattern=LinePattern.None, fillColor={246, 241, 252},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
An ellipsoid, centred at the origin of its record, with its half axes along x, y and z.
</p>
</html>"));
end Ellipsoid;
