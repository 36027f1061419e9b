within UrdfSync.Examples.SixAxisArm;

model SixAxisArm "Robot SixAxisArm"
  extends UrdfSync.Robots.PartialStationaryRobot;

  constant Integer turretAxis = 1
    "Number of joint \"turret\" in rotationalAxis";

  constant Integer shoulderAxis = 2
    "Number of joint \"shoulder\" in rotationalAxis";

  constant Integer elbowAxis = 3
    "Number of joint \"elbow\" in rotationalAxis";

  constant Integer forearm_rollAxis = 4
    "Number of joint \"forearm_roll\" in rotationalAxis";

  constant Integer wrist_pitchAxis = 5
    "Number of joint \"wrist_pitch\" in rotationalAxis";

  constant Integer flange_rollAxis = 6
    "Number of joint \"flange_roll\" in rotationalAxis";

  constant Integer gripper_strokeAxis = 1
    "Number of joint \"gripper_stroke\" in translationalAxis";

  constant Integer finger_rightFrame = 1
    "Number of link \"finger_right\" in frame_b";

  constant Integer grasp_pointFrame = 2
    "Number of link \"grasp_point\" in frame_b";

  constant Integer finger_leftFrame = 3
    "Number of link \"finger_left\" in frame_b";

  constant Integer drive_pinionFrame = 4
    "Number of link \"drive_pinion\" in frame_b";

  final parameter Real rotationalRange[6, 3] = {
    {turret.parameters.limits.lower, turret.parameters.limits.upper, turret.parameters.limits.velocity},
    {shoulder.parameters.limits.lower, shoulder.parameters.limits.upper, shoulder.parameters.limits.velocity},
    {elbow.parameters.limits.lower, elbow.parameters.limits.upper, elbow.parameters.limits.velocity},
    {forearm_roll.parameters.limits.lower, forearm_roll.parameters.limits.upper, forearm_roll.parameters.limits.velocity},
    {wrist_pitch.parameters.limits.lower, wrist_pitch.parameters.limits.upper, wrist_pitch.parameters.limits.velocity},
    {flange_roll.parameters.limits.lower, flange_roll.parameters.limits.upper, flange_roll.parameters.limits.velocity}}
    "Ranges of rotationalAxis, those of joints that follow an axis included: {lower, upper, velocity}";

  parameter Modelica.Units.SI.Angle phi_start[6] = {
    UrdfSync.Functions.closestToZero(rotationalRange[1, 1], rotationalRange[1, 2]),
    UrdfSync.Functions.closestToZero(rotationalRange[2, 1], rotationalRange[2, 2]),
    UrdfSync.Functions.closestToZero(rotationalRange[3, 1], rotationalRange[3, 2]),
    UrdfSync.Functions.closestToZero(rotationalRange[4, 1], rotationalRange[4, 2]),
    UrdfSync.Functions.closestToZero(rotationalRange[5, 1], rotationalRange[5, 2]),
    UrdfSync.Functions.closestToZero(rotationalRange[6, 1], rotationalRange[6, 2])}
    "Start values of the positions"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.AngularVelocity w_start[6] = zeros(6)
    "Start values of the speeds"
    annotation (Dialog(tab="Initialization"));

  final parameter Real translationalRange[1, 3] = {
    UrdfSync.Functions.leaderRange(UrdfSync.Functions.leaderRange({gripper_stroke.parameters.limits.lower, gripper_stroke.parameters.limits.upper, gripper_stroke.parameters.limits.velocity}, finger_coupling.parameters.mimic.multiplier, finger_coupling.parameters.mimic.offset, {finger_coupling.parameters.limits.lower, finger_coupling.parameters.limits.upper, finger_coupling.parameters.limits.velocity}), pinion_coupling.parameters.mimic.multiplier, pinion_coupling.parameters.mimic.offset, {pinion_coupling.parameters.limits.lower, pinion_coupling.parameters.limits.upper, pinion_coupling.parameters.limits.velocity})}
    "Ranges of translationalAxis, those of joints that follow an axis included: {lower, upper, velocity}";

  parameter Modelica.Units.SI.Position s_start[1] = {
    UrdfSync.Functions.closestToZero(translationalRange[1, 1], translationalRange[1, 2])}
    "Start values of the positions"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Velocity v_start[1] = zeros(1)
    "Start values of the speeds"
    annotation (Dialog(tab="Initialization"));

  final parameter Modelica.Units.SI.Mass m =
    base_link.m +
    carousel.m +
    upper_arm.m +
    elbow_housing.m +
    forearm.m +
    wrist.m +
    mounting_flange.m +
    tool0.m +
    gripper_body.m +
    finger_right.m +
    grasp_point.m +
    finger_left.m +
    drive_pinion.m
    "Mass of the whole robot";

  Modelica.Mechanics.Rotational.Interfaces.Flange_a rotationalAxis[6]
    "Drives"
    annotation (Placement(transformation(extent={{42, 156}, {62, 176}}), iconTransformation(extent={{-70, 90}, {-50, 110}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rotationalSupport[6]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{90, 156}, {110, 176}}), iconTransformation(extent={{-40, 90}, {-20, 110}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a translationalAxis[1]
    "Drives"
    annotation (Placement(transformation(extent={{138, 156}, {158, 176}}), iconTransformation(extent={{20, 90}, {40, 110}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b translationalSupport[1]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{186, 156}, {206, 176}}), iconTransformation(extent={{50, 90}, {70, 110}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b[4]
    "Frames of the links without children"
    annotation (Placement(transformation(extent={{252, 78}, {284, 110}}), iconTransformation(extent={{84, -16}, {116, 16}})));

  Links.Base_link base_link(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"base_link\""
    annotation (Placement(transformation(extent={{-240, 58}, {-220, 78}})));

  Links.Carousel carousel(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"carousel\""
    annotation (Placement(transformation(extent={{-192, 58}, {-172, 78}})));

  Links.Upper_arm upper_arm(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"upper_arm\""
    annotation (Placement(transformation(extent={{-144, 58}, {-124, 78}})));

  Links.Elbow_housing elbow_housing(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"elbow_housing\""
    annotation (Placement(transformation(extent={{-96, 58}, {-76, 78}})));

  Links.Forearm forearm(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"forearm\""
    annotation (Placement(transformation(extent={{-48, 58}, {-28, 78}})));

  Links.Wrist wrist(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"wrist\""
    annotation (Placement(transformation(extent={{0, 58}, {20, 78}})));

  Links.Mounting_flange mounting_flange(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"mounting_flange\""
    annotation (Placement(transformation(extent={{48, 58}, {68, 78}})));

  Links.Tool0 tool0(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"tool0\""
    annotation (Placement(transformation(extent={{96, 58}, {116, 78}})));

  Links.Gripper_body gripper_body(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"gripper_body\""
    annotation (Placement(transformation(extent={{144, 58}, {164, 78}})));

  Links.Finger_right finger_right(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"finger_right\""
    annotation (Placement(transformation(extent={{192, 58}, {212, 78}})));

  Links.Grasp_point grasp_point(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"grasp_point\""
    annotation (Placement(transformation(extent={{192, -4}, {212, 16}})));

  Links.Finger_left finger_left(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"finger_left\""
    annotation (Placement(transformation(extent={{192, -78}, {212, -58}})));

  Links.Drive_pinion drive_pinion(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"drive_pinion\""
    annotation (Placement(transformation(extent={{192, -168}, {212, -148}})));

  Joints.Turret turret(
    axisNumber = 1,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[1],
    w_start = w_start[1])
    "Revolute joint \"turret\" from link \"base_link\" to link \"carousel\""
    annotation (Placement(transformation(extent={{-224, 84}, {-204, 104}})));

  Joints.Shoulder shoulder(
    axisNumber = 2,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[2],
    w_start = w_start[2])
    "Revolute joint \"shoulder\" from link \"carousel\" to link \"upper_arm\""
    annotation (Placement(transformation(extent={{-176, 84}, {-156, 104}})));

  Joints.Elbow elbow(
    axisNumber = 3,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[3],
    w_start = w_start[3])
    "Revolute joint \"elbow\" from link \"upper_arm\" to link \"elbow_housing\""
    annotation (Placement(transformation(extent={{-128, 84}, {-108, 104}})));

  Joints.Forearm_roll forearm_roll(
    axisNumber = 4,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[4],
    w_start = w_start[4])
    "Revolute joint \"forearm_roll\" from link \"elbow_housing\" to link \"forearm\""
    annotation (Placement(transformation(extent={{-80, 84}, {-60, 104}})));

  Joints.Wrist_pitch wrist_pitch(
    axisNumber = 5,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[5],
    w_start = w_start[5])
    "Revolute joint \"wrist_pitch\" from link \"forearm\" to link \"wrist\""
    annotation (Placement(transformation(extent={{-32, 84}, {-12, 104}})));

  Joints.Flange_roll flange_roll(
    axisNumber = 6,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[6],
    w_start = w_start[6])
    "Revolute joint \"flange_roll\" from link \"wrist\" to link \"mounting_flange\""
    annotation (Placement(transformation(extent={{16, 84}, {36, 104}})));

  Joints.Flange_to_tool flange_to_tool
    "Fixed joint \"flange_to_tool\" from link \"mounting_flange\" to link \"tool0\""
    annotation (Placement(transformation(extent={{64, 84}, {84, 104}})));

  Joints.Gripper_mount gripper_mount
    "Fixed joint \"gripper_mount\" from link \"tool0\" to link \"gripper_body\""
    annotation (Placement(transformation(extent={{112, 84}, {132, 104}})));

  Joints.Finger_coupling finger_coupling(
    checkLimits = checkLimits,
    fixedStart = false,
    s_start = finger_coupling.parameters.mimic.multiplier*gripper_stroke.s_start + finger_coupling.parameters.mimic.offset)
    "Prismatic joint \"finger_coupling\" from link \"gripper_body\" to link \"finger_right\""
    annotation (Placement(transformation(extent={{160, 84}, {180, 104}})));

  Joints.Grasp_frame grasp_frame
    "Fixed joint \"grasp_frame\" from link \"gripper_body\" to link \"grasp_point\""
    annotation (Placement(transformation(extent={{160, 22}, {180, 42}})));

  Joints.Gripper_stroke gripper_stroke(
    axisNumber = 1,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    s_start = s_start[1],
    v_start = v_start[1])
    "Prismatic joint \"gripper_stroke\" from link \"gripper_body\" to link \"finger_left\""
    annotation (Placement(transformation(extent={{160, -52}, {180, -32}})));

  Joints.Pinion_coupling pinion_coupling(
    checkLimits = checkLimits,
    fixedStart = false,
    phi_start = pinion_coupling.parameters.mimic.multiplier*gripper_stroke.s_start + pinion_coupling.parameters.mimic.offset)
    "Revolute joint \"pinion_coupling\" from link \"gripper_body\" to link \"drive_pinion\""
    annotation (Placement(transformation(extent={{160, -142}, {180, -122}})));

  UrdfSync.Couplings.TranslationalToTranslational finger_couplingMimic(parameters = finger_coupling.parameters.mimic)
    "Joint \"finger_coupling\" follows joint \"gripper_stroke\""
    annotation (Placement(transformation(extent={{144, 112}, {164, 132}})));

  UrdfSync.Couplings.TranslationalToRotational pinion_couplingMimic(parameters = pinion_coupling.parameters.mimic)
    "Joint \"pinion_coupling\" follows joint \"gripper_stroke\""
    annotation (Placement(transformation(extent={{144, -114}, {164, -94}})));

equation
  connect(frame_a, base_link.frame_a)
    annotation (Line(points={{-268, 94}, {-244, 94}, {-244, 68}, {-240, 68}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, turret.frame_a)
    annotation (Line(points={{-240, 68}, {-244, 68}, {-244, 94}, {-224, 94}}, color={95, 95, 95}, thickness=0.5));
  connect(turret.frame_b, carousel.frame_a)
    annotation (Line(points={{-204, 94}, {-196, 94}, {-196, 68}, {-192, 68}}, color={95, 95, 95}, thickness=0.5));
  connect(carousel.frame_a, shoulder.frame_a)
    annotation (Line(points={{-192, 68}, {-196, 68}, {-196, 94}, {-176, 94}}, color={95, 95, 95}, thickness=0.5));
  connect(shoulder.frame_b, upper_arm.frame_a)
    annotation (Line(points={{-156, 94}, {-148, 94}, {-148, 68}, {-144, 68}}, color={95, 95, 95}, thickness=0.5));
  connect(upper_arm.frame_a, elbow.frame_a)
    annotation (Line(points={{-144, 68}, {-148, 68}, {-148, 94}, {-128, 94}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow.frame_b, elbow_housing.frame_a)
    annotation (Line(points={{-108, 94}, {-100, 94}, {-100, 68}, {-96, 68}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow_housing.frame_a, forearm_roll.frame_a)
    annotation (Line(points={{-96, 68}, {-100, 68}, {-100, 94}, {-80, 94}}, color={95, 95, 95}, thickness=0.5));
  connect(forearm_roll.frame_b, forearm.frame_a)
    annotation (Line(points={{-60, 94}, {-52, 94}, {-52, 68}, {-48, 68}}, color={95, 95, 95}, thickness=0.5));
  connect(forearm.frame_a, wrist_pitch.frame_a)
    annotation (Line(points={{-48, 68}, {-52, 68}, {-52, 94}, {-32, 94}}, color={95, 95, 95}, thickness=0.5));
  connect(wrist_pitch.frame_b, wrist.frame_a)
    annotation (Line(points={{-12, 94}, {-4, 94}, {-4, 68}, {0, 68}}, color={95, 95, 95}, thickness=0.5));
  connect(wrist.frame_a, flange_roll.frame_a)
    annotation (Line(points={{0, 68}, {-4, 68}, {-4, 94}, {16, 94}}, color={95, 95, 95}, thickness=0.5));
  connect(flange_roll.frame_b, mounting_flange.frame_a)
    annotation (Line(points={{36, 94}, {44, 94}, {44, 68}, {48, 68}}, color={95, 95, 95}, thickness=0.5));
  connect(mounting_flange.frame_a, flange_to_tool.frame_a)
    annotation (Line(points={{48, 68}, {44, 68}, {44, 94}, {64, 94}}, color={95, 95, 95}, thickness=0.5));
  connect(flange_to_tool.frame_b, tool0.frame_a)
    annotation (Line(points={{84, 94}, {92, 94}, {92, 68}, {96, 68}}, color={95, 95, 95}, thickness=0.5));
  connect(tool0.frame_a, gripper_mount.frame_a)
    annotation (Line(points={{96, 68}, {92, 68}, {92, 94}, {112, 94}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_mount.frame_b, gripper_body.frame_a)
    annotation (Line(points={{132, 94}, {140, 94}, {140, 68}, {144, 68}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, finger_coupling.frame_a)
    annotation (Line(points={{144, 68}, {140, 68}, {140, 94}, {160, 94}}, color={95, 95, 95}, thickness=0.5));
  connect(finger_coupling.frame_b, finger_right.frame_a)
    annotation (Line(points={{180, 94}, {188, 94}, {188, 68}, {192, 68}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, grasp_frame.frame_a)
    annotation (Line(points={{144, 68}, {140, 68}, {140, 32}, {160, 32}}, color={95, 95, 95}, thickness=0.5));
  connect(grasp_frame.frame_b, grasp_point.frame_a)
    annotation (Line(points={{180, 32}, {188, 32}, {188, 6}, {192, 6}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, gripper_stroke.frame_a)
    annotation (Line(points={{144, 68}, {140, 68}, {140, -42}, {160, -42}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_stroke.frame_b, finger_left.frame_a)
    annotation (Line(points={{180, -42}, {188, -42}, {188, -68}, {192, -68}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, pinion_coupling.frame_a)
    annotation (Line(points={{144, 68}, {140, 68}, {140, -132}, {160, -132}}, color={95, 95, 95}, thickness=0.5));
  connect(pinion_coupling.frame_b, drive_pinion.frame_a)
    annotation (Line(points={{180, -132}, {188, -132}, {188, -158}, {192, -158}}, color={95, 95, 95}, thickness=0.5));
  connect(finger_right.frame_a, frame_b[1])
    annotation (Line(points={{192, 68}, {188, 68}, {188, 94}, {268, 94}}, color={95, 95, 95}, thickness=0.5));
  connect(grasp_point.frame_a, frame_b[2])
    annotation (Line(points={{192, 6}, {188, 6}, {188, 32}, {244, 32}, {244, 94}, {268, 94}}, color={95, 95, 95}, thickness=0.5));
  connect(finger_left.frame_a, frame_b[3])
    annotation (Line(points={{192, -68}, {188, -68}, {188, -42}, {244, -42}, {244, 94}, {268, 94}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_pinion.frame_a, frame_b[4])
    annotation (Line(points={{192, -158}, {188, -158}, {188, -132}, {244, -132}, {244, 94}, {268, 94}}, color={95, 95, 95}, thickness=0.5));
  connect(turret.axis, rotationalAxis[1])
    annotation (Line(points={{-214, 104}, {-214, 140}, {52, 140}, {52, 166}}, color={0, 0, 0}));
  connect(turret.support, rotationalSupport[1])
    annotation (Line(points={{-220, 104}, {-220, 144}, {100, 144}, {100, 166}}, color={0, 0, 0}));
  connect(shoulder.axis, rotationalAxis[2])
    annotation (Line(points={{-166, 104}, {-166, 140}, {52, 140}, {52, 166}}, color={0, 0, 0}));
  connect(shoulder.support, rotationalSupport[2])
    annotation (Line(points={{-172, 104}, {-172, 144}, {100, 144}, {100, 166}}, color={0, 0, 0}));
  connect(elbow.axis, rotationalAxis[3])
    annotation (Line(points={{-118, 104}, {-118, 140}, {52, 140}, {52, 166}}, color={0, 0, 0}));
  connect(elbow.support, rotationalSupport[3])
    annotation (Line(points={{-124, 104}, {-124, 144}, {100, 144}, {100, 166}}, color={0, 0, 0}));
  connect(forearm_roll.axis, rotationalAxis[4])
    annotation (Line(points={{-70, 104}, {-70, 140}, {52, 140}, {52, 166}}, color={0, 0, 0}));
  connect(forearm_roll.support, rotationalSupport[4])
    annotation (Line(points={{-76, 104}, {-76, 144}, {100, 144}, {100, 166}}, color={0, 0, 0}));
  connect(wrist_pitch.axis, rotationalAxis[5])
    annotation (Line(points={{-22, 104}, {-22, 140}, {52, 140}, {52, 166}}, color={0, 0, 0}));
  connect(wrist_pitch.support, rotationalSupport[5])
    annotation (Line(points={{-28, 104}, {-28, 144}, {100, 144}, {100, 166}}, color={0, 0, 0}));
  connect(flange_roll.axis, rotationalAxis[6])
    annotation (Line(points={{26, 104}, {26, 140}, {52, 140}, {52, 166}}, color={0, 0, 0}));
  connect(flange_roll.support, rotationalSupport[6])
    annotation (Line(points={{20, 104}, {20, 144}, {100, 144}, {100, 166}}, color={0, 0, 0}));
  connect(gripper_stroke.axis, translationalAxis[1])
    annotation (Line(points={{170, -32}, {170, -20}, {238, -20}, {238, 148}, {148, 148}, {148, 166}}, color={0, 127, 0}));
  connect(gripper_stroke.support, translationalSupport[1])
    annotation (Line(points={{164, -32}, {164, -16}, {232, -16}, {232, 152}, {196, 152}, {196, 166}}, color={0, 127, 0}));
  connect(finger_couplingMimic.follower, finger_coupling.axis)
    annotation (Line(points={{164, 122}, {170, 122}, {170, 104}}, color={0, 127, 0}));
  connect(finger_couplingMimic.leader, gripper_stroke.axis)
    annotation (Line(points={{144, 122}, {136, 122}, {136, -24}, {170, -24}, {170, -32}}, color={0, 127, 0}));
  connect(pinion_couplingMimic.follower, pinion_coupling.axis)
    annotation (Line(points={{164, -104}, {170, -104}, {170, -122}}, color={0, 0, 0}));
  connect(pinion_couplingMimic.leader, gripper_stroke.axis)
    annotation (Line(points={{144, -104}, {136, -104}, {136, -24}, {170, -24}, {170, -32}}, color={0, 127, 0}));

  annotation (
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-284, -176}, {284, 176}})),
    Documentation(info="<html>
<p>
Links and joints of robot SixAxisArm, connected. The flange vectors hold the axes that can be driven; the constants <code>...Axis</code> and <code>...Frame</code> are their numbers, and keep their meaning when the robot changes. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end SixAxisArm;
