within UrdfSync.Examples.PlanarPlatform;

model PlanarPlatform "Robot PlanarPlatform"
  extends UrdfSync.Robots.PartialStationaryRobot;

  constant Integer boom_swingAxis = 1
    "Number of joint \"boom_swing\" in rotationalAxis";

  constant Integer boomFrame = 1
    "Number of link \"boom\" in frame_b";

  final parameter Real rotationalRange[1, 3] = {
    {boom_swing.parameters.limits.lower, boom_swing.parameters.limits.upper, boom_swing.parameters.limits.velocity}}
    "Ranges of rotationalAxis, those of joints that follow an axis included: {lower, upper, velocity}";

  parameter Modelica.Units.SI.Angle phi_start[1] = {
    UrdfSync.Functions.closestToZero(rotationalRange[1, 1], rotationalRange[1, 2])}
    "Start values of the positions"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.AngularVelocity w_start[1] = zeros(1)
    "Start values of the speeds"
    annotation (Dialog(tab="Initialization"));

  final parameter Modelica.Units.SI.Mass m =
    world_link.m +
    platform.m +
    boom.m
    "Mass of the whole robot";

  Modelica.Mechanics.Rotational.Interfaces.Flange_a rotationalAxis[1]
    "Drives"
    annotation (Placement(transformation(extent={{-30, 26}, {-10, 46}}), iconTransformation(extent={{-70, 90}, {-50, 110}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rotationalSupport[1]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{18, 26}, {38, 46}}), iconTransformation(extent={{-40, 90}, {-20, 110}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b[1]
    "Frames of the links without children"
    annotation (Placement(transformation(extent={{72, -16}, {104, 16}}), iconTransformation(extent={{84, -16}, {116, 16}})));

  Links.World_link world_link(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"world\""
    annotation (Placement(transformation(extent={{-72, -36}, {-52, -16}})));

  Links.Platform platform(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"platform\""
    annotation (Placement(transformation(extent={{-24, -36}, {-4, -16}})));

  Links.Boom boom(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"boom\""
    annotation (Placement(transformation(extent={{24, -36}, {44, -16}})));

  Joints.Glide glide
    "Planar joint \"glide\" from link \"world\" to link \"platform\""
    annotation (Placement(transformation(extent={{-56, -10}, {-36, 10}})));

  Joints.Boom_swing boom_swing(
    axisNumber = 1,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[1],
    w_start = w_start[1])
    "Revolute joint \"boom_swing\" from link \"platform\" to link \"boom\""
    annotation (Placement(transformation(extent={{-8, -10}, {12, 10}})));

equation
  connect(frame_a, world_link.frame_a)
    annotation (Line(points={{-100, 0}, {-76, 0}, {-76, -26}, {-72, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(world_link.frame_a, glide.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, 0}, {-56, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(glide.frame_b, platform.frame_a)
    annotation (Line(points={{-36, 0}, {-28, 0}, {-28, -26}, {-24, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(platform.frame_a, boom_swing.frame_a)
    annotation (Line(points={{-24, -26}, {-28, -26}, {-28, 0}, {-8, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(boom_swing.frame_b, boom.frame_a)
    annotation (Line(points={{12, 0}, {20, 0}, {20, -26}, {24, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(boom.frame_a, frame_b[1])
    annotation (Line(points={{24, -26}, {20, -26}, {20, 0}, {88, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(boom_swing.axis, rotationalAxis[1])
    annotation (Line(points={{2, 10}, {2, 18}, {-20, 18}, {-20, 36}}, color={0, 0, 0}));
  connect(boom_swing.support, rotationalSupport[1])
    annotation (Line(points={{-4, 10}, {-4, 22}, {28, 22}, {28, 36}}, color={0, 0, 0}));

  annotation (
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -44}, {104, 46}})),
    Documentation(info="<html>
<p>
Links and joints of robot PlanarPlatform, connected. The flange vectors hold the axes that can be driven; the constants <code>...Axis</code> and <code>...Frame</code> are their numbers, and keep their meaning when the robot changes. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end PlanarPlatform;
