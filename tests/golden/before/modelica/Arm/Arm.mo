within Arm;

model Arm "Robot Arm"
  extends UrdfSync.Robots.PartialStationaryRobot;

  constant Integer swingAxis = 1
    "Number of joint \"swing\" in rotationalAxis";

  constant Integer boomFrame = 1
    "Number of link \"boom\" in frame_b";

  final parameter Real rotationalRange[1, 3] = {
    {swing.parameters.limits.lower, swing.parameters.limits.upper, swing.parameters.limits.velocity}}
    "Ranges of rotationalAxis, those of joints that follow an axis included: {lower, upper, velocity}";

  parameter Modelica.Units.SI.Angle phi_start[1] = {
    UrdfSync.Functions.closestToZero(rotationalRange[1, 1], rotationalRange[1, 2])}
    "Start values of the positions"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.AngularVelocity w_start[1] = zeros(1)
    "Start values of the speeds"
    annotation (Dialog(tab="Initialization"));

  final parameter Modelica.Units.SI.Mass m =
    base.m +
    boom.m
    "Mass of the whole robot";

  Modelica.Mechanics.Rotational.Interfaces.Flange_a rotationalAxis[1]
    "Drives"
    annotation (Placement(transformation(extent={{-78, 26}, {-58, 46}}), iconTransformation(extent={{-70, 90}, {-50, 110}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rotationalSupport[1]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{-30, 26}, {-10, 46}}), iconTransformation(extent={{-40, 90}, {-20, 110}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b[1]
    "Frames of the links without children"
    annotation (Placement(transformation(extent={{24, -16}, {56, 16}}), iconTransformation(extent={{84, -16}, {116, 16}})));

  Links.Base base(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"base\""
    annotation (Placement(transformation(extent={{-72, -36}, {-52, -16}})));

  Links.Boom boom(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"boom\""
    annotation (Placement(transformation(extent={{-24, -36}, {-4, -16}})));

  Joints.Swing swing(
    axisNumber = 1,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[1],
    w_start = w_start[1])
    "Revolute joint \"swing\" from link \"base\" to link \"boom\""
    annotation (Placement(transformation(extent={{-56, -10}, {-36, 10}})));

equation
  connect(frame_a, base.frame_a)
    annotation (Line(points={{-100, 0}, {-76, 0}, {-76, -26}, {-72, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(base.frame_a, swing.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, 0}, {-56, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(swing.frame_b, boom.frame_a)
    annotation (Line(points={{-36, 0}, {-28, 0}, {-28, -26}, {-24, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(boom.frame_a, frame_b[1])
    annotation (Line(points={{-24, -26}, {-28, -26}, {-28, 0}, {40, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(swing.axis, rotationalAxis[1])
    annotation (Line(points={{-46, 10}, {-46, 18}, {-68, 18}, {-68, 36}}, color={0, 0, 0}));
  connect(swing.support, rotationalSupport[1])
    annotation (Line(points={{-52, 10}, {-52, 22}, {-20, 22}, {-20, 36}}, color={0, 0, 0}));

  annotation (
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -44}, {56, 46}})),
    Documentation(info="<html>
<p>
Links and joints of robot Arm, connected. The flange vectors hold the axes that can be driven; the constants <code>...Axis</code> and <code>...Frame</code> are their numbers, and keep their meaning when the robot changes. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end Arm;
