within UrdfSync.Visualizers;

model Box "Box"
  extends UrdfSync.Visualizers.PartialShape;

  parameter UrdfSync.Records.Box parameters
    "Place, colour and size";

protected
  final parameter Real R[3, 3] = UrdfSync.Functions.rotation(parameters.origin.rpy)
    "Axes of the shape frame as columns, resolved in frame_a";

  Modelica.Mechanics.MultiBody.Visualizers.Advanced.Shape shape(
    shapeType = "box",
    length = parameters.size[1],
    width = parameters.size[2],
    height = parameters.size[3],
    lengthDirection = R[:, 1],
    widthDirection = R[:, 2],
    r_shape = parameters.origin.xyz - 0.5*parameters.size[1]*R[:, 1],
    color = parameters.color,
    r = frame_a.r_0,
    R = frame_a.R) if world.enableAnimation and animation
    "Box";

  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Polygon(points={{15, -2}, {-41, 30}, {15, 62}, {71, 30}, {15, -2}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={226, 236, 248}, fillPattern=FillPattern.Solid),
        Polygon(points={{15, -2}, {-41, 30}, {-41, -32}, {15, -64}, {15, -2}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Polygon(points={{15, -2}, {71, 30}, {71, -32}, {15, -64}, {15, -2}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={160, 186, 222}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A box, centred at the origin of its record.
</p>
</html>"));
end Box;
