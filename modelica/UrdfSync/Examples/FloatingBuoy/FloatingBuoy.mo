within UrdfSync.Examples.FloatingBuoy;

model FloatingBuoy "Robot FloatingBuoy"
  extends UrdfSync.Robots.PartialStationaryRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b clapperFrame
    "Frame of link \"clapper\""
    annotation (Placement(transformation(extent={{76, -10}, {96, 10}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a clapper_swingAxis
    "Axis of joint \"clapper_swing\""
    annotation (Placement(transformation(extent={{20, 14}, {32, 26}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b clapper_swingSupport
    "Housing of the drive of joint \"clapper_swing\""
    annotation (Placement(transformation(extent={{6, 14}, {18, 26}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

  final parameter Modelica.Units.SI.Mass m =
    worldLink.m +
    buoy.m +
    clapper.m
    "Mass of the whole robot";

  replaceable Links.WorldLink worldLink(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"world\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-60, -36}, {-40, -16}})));

  replaceable Links.Buoy buoy(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"buoy\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -36}, {20, -16}})));

  replaceable Links.Clapper clapper(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"clapper\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -36}, {80, -16}})));

  replaceable Joints.Drift drift constrainedby UrdfSync.Interfaces.PartialFloatingJoint
    "Floating joint \"drift\" from link \"world\" to link \"buoy\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -10}, {-24, 10}})));

  replaceable Joints.Clapper_swing clapper_swing(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"clapper_swing\" from link \"buoy\" to link \"clapper\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -10}, {36, 10}})));

equation
  connect(frame_a, worldLink.frame_a)
    annotation (Line(points={{-100, 0}, {-64, 0}, {-64, -26}, {-60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(worldLink.frame_a, drift.frame_a)
    annotation (Line(points={{-60, -26}, {-64, -26}, {-64, 0}, {-44, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(drift.frame_b, buoy.frame_a)
    annotation (Line(points={{-24, 0}, {-4, 0}, {-4, -26}, {0, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(buoy.frame_a, clapper_swing.frame_a)
    annotation (Line(points={{0, -26}, {-4, -26}, {-4, 0}, {16, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(clapper_swing.frame_b, clapper.frame_a)
    annotation (Line(points={{36, 0}, {56, 0}, {56, -26}, {60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(clapper.frame_a, clapperFrame)
    annotation (Line(points={{60, -26}, {56, -26}, {56, 0}, {86, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(clapper_swing.axis, clapper_swingAxis)
    annotation (Line(points={{26, 10}, {26, 20}}, color={0, 0, 0}));
  connect(clapper_swing.support, clapper_swingSupport)
    annotation (Line(points={{20, 10}, {20, 12}, {12, 12}, {12, 20}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 130}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 130}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="clapper_swing"),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="clapper")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -44}, {120, 34}})),
    Documentation(info="<html>
<p>
Links and joints of robot FloatingBuoy, connected. Each can be exchanged in a model that extends this one. Each joint that can be driven has two flanges for its drive: its name with <code>Axis</code> and with <code>Support</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-3d0d", base = "d459519e0d763b3e"));
end FloatingBuoy;
