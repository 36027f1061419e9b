within Post;

model Post "Robot Post"
  extends UrdfSync.Robots.PartialStationaryRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b mastFrame
    "Frame of link \"mast\""
    annotation (Placement(transformation(extent={{-44, -10}, {-24, 10}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  final parameter Modelica.Units.SI.Mass m =
    mast.m
    "Mass of the whole robot";

  replaceable Links.Mast mast(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"mast\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-60, -36}, {-40, -16}})));

equation
  connect(frame_a, mast.frame_a)
    annotation (Line(points={{-100, 0}, {-64, 0}, {-64, -26}, {-60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(mast.frame_a, mastFrame)
    annotation (Line(points={{-60, -26}, {-64, -26}, {-64, 0}, {-34, 0}}, color={95, 95, 95}, thickness=0.5));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 130}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 130}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="mast")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -44}, {0, 34}})),
    Documentation(info="<html>
<p>
Links and joints of robot Post, connected. Each can be exchanged in a model that extends this one. Each joint that can be driven has two flanges for its drive: its name with <code>Axis</code> and with <code>Support</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end Post;
