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

  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Ellipse(extent={{-35, -64}, {65, -30}}, lineColor={38, 115, 65}, lineThickness=0.5, fillColor={205, 235, 213},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{-35, -47}, {65, 45}}, pattern=LinePattern.None, fillColor={205, 235, 213},
            fillPattern=FillPattern.Solid),
        Line(points={{-35, 45}, {-35, -47}}, color={38, 115, 65}, thickness=0.5),
        Line(points={{65, 45}, {65, -47}}, color={38, 115, 65}, thickness=0.5),
        Ellipse(extent={{-35, 28}, {65, 62}}, lineColor={38, 115, 65}, lineThickness=0.5, fillColor={232, 246, 236},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A cylinder along z, centred at the origin of its record.
</p>
</html>"));
end Cylinder;
