within UrdfSync.Examples.FloatingBuoy;

model FloatingBuoy "Robot FloatingBuoy"
  extends UrdfSync.Robots.PartialStationaryRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b clapperFrame
    "Frame of link \"clapper\""
    annotation (Placement(transformation(extent={{40, -10}, {60, 10}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a clapper_swingAxis
    "Axis of joint \"clapper_swing\""
    annotation (Placement(transformation(extent={{-4, 14}, {8, 26}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b clapper_swingSupport
    "Housing of the drive of joint \"clapper_swing\""
    annotation (Placement(transformation(extent={{-18, 14}, {-6, 26}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

  final parameter Modelica.Units.SI.Mass m =
    world_link.m +
    buoy.m +
    clapper.m
    "Mass of the whole robot";

  replaceable Links.World_link world_link(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"world\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-72, -36}, {-52, -16}})));

  replaceable Links.Buoy buoy(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"buoy\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-24, -36}, {-4, -16}})));

  replaceable Links.Clapper clapper(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"clapper\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{24, -36}, {44, -16}})));

  replaceable Joints.Drift drift constrainedby UrdfSync.Interfaces.PartialFloatingJoint
    "Floating joint \"drift\" from link \"world\" to link \"buoy\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -10}, {-36, 10}})));

  replaceable Joints.Clapper_swing clapper_swing(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"clapper_swing\" from link \"buoy\" to link \"clapper\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-8, -10}, {12, 10}})));

equation
  connect(frame_a, world_link.frame_a)
    annotation (Line(points={{-100, 0}, {-76, 0}, {-76, -26}, {-72, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(world_link.frame_a, drift.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, 0}, {-56, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(drift.frame_b, buoy.frame_a)
    annotation (Line(points={{-36, 0}, {-28, 0}, {-28, -26}, {-24, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(buoy.frame_a, clapper_swing.frame_a)
    annotation (Line(points={{-24, -26}, {-28, -26}, {-28, 0}, {-8, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(clapper_swing.frame_b, clapper.frame_a)
    annotation (Line(points={{12, 0}, {20, 0}, {20, -26}, {24, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(clapper.frame_a, clapperFrame)
    annotation (Line(points={{24, -26}, {20, -26}, {20, 0}, {50, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(clapper_swing.axis, clapper_swingAxis)
    annotation (Line(points={{2, 10}, {2, 20}}, color={0, 0, 0}));
  connect(clapper_swing.support, clapper_swingSupport)
    annotation (Line(points={{-4, 10}, {-4, 12}, {-12, 12}, {-12, 20}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 130}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 130}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="clapper_swing"),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="clapper")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -44}, {84, 34}})),
    Documentation(info="<html>
<p>
Links and joints of robot FloatingBuoy, connected. Each can be exchanged in a model that extends this one. A drive of joint <code>elbow</code>, say, is connected to <code>elbowAxis</code> and <code>elbowSupport</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end FloatingBuoy;
