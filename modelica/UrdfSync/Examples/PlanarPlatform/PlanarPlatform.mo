within UrdfSync.Examples.PlanarPlatform;

model PlanarPlatform "Robot PlanarPlatform"
  extends UrdfSync.Robots.PartialStationaryRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b boomFrame
    "Frame of link \"boom\""
    annotation (Placement(transformation(extent={{76, -10}, {96, 10}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a boom_swingAxis
    "Axis of joint \"boom_swing\""
    annotation (Placement(transformation(extent={{20, 14}, {32, 26}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b boom_swingSupport
    "Housing of the drive of joint \"boom_swing\""
    annotation (Placement(transformation(extent={{6, 14}, {18, 26}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

  final parameter Modelica.Units.SI.Mass m =
    worldLink.m +
    platform.m +
    boom.m
    "Mass of the whole robot";

  replaceable Links.WorldLink worldLink(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"world\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-60, -36}, {-40, -16}})));

  replaceable Links.Platform platform(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"platform\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -36}, {20, -16}})));

  replaceable Links.Boom boom(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"boom\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -36}, {80, -16}})));

  replaceable Joints.Glide glide constrainedby UrdfSync.Interfaces.PartialPlanarJoint
    "Planar joint \"glide\" from link \"world\" to link \"platform\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -10}, {-24, 10}})));

  replaceable Joints.Boom_swing boom_swing(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"boom_swing\" from link \"platform\" to link \"boom\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -10}, {36, 10}})));

equation
  connect(frame_a, worldLink.frame_a)
    annotation (Line(points={{-100, 0}, {-64, 0}, {-64, -26}, {-60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(worldLink.frame_a, glide.frame_a)
    annotation (Line(points={{-60, -26}, {-64, -26}, {-64, 0}, {-44, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(glide.frame_b, platform.frame_a)
    annotation (Line(points={{-24, 0}, {-4, 0}, {-4, -26}, {0, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(platform.frame_a, boom_swing.frame_a)
    annotation (Line(points={{0, -26}, {-4, -26}, {-4, 0}, {16, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(boom_swing.frame_b, boom.frame_a)
    annotation (Line(points={{36, 0}, {56, 0}, {56, -26}, {60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(boom.frame_a, boomFrame)
    annotation (Line(points={{60, -26}, {56, -26}, {56, 0}, {86, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(boom_swing.axis, boom_swingAxis)
    annotation (Line(points={{26, 10}, {26, 20}}, color={0, 0, 0}));
  connect(boom_swing.support, boom_swingSupport)
    annotation (Line(points={{20, 10}, {20, 12}, {12, 12}, {12, 20}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 130}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 130}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="boom_swing"),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="boom")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -44}, {120, 34}})),
    Documentation(info="<html>
<p>
Links and joints of robot PlanarPlatform, connected. Each can be exchanged in a model that extends this one. Each joint that can be driven has two flanges for its drive: its name with <code>Axis</code> and with <code>Support</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-3d0d", base = "167d5157e52ac30e"));
end PlanarPlatform;
