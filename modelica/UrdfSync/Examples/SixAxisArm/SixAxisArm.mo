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
    annotation (Placement(transformation(extent={{210, 62}, {230, 82}}), iconTransformation(extent={{-70, 90}, {-50, 110}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rotationalSupport[6]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{258, 62}, {278, 82}}), iconTransformation(extent={{-40, 90}, {-20, 110}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a translationalAxis[1]
    "Drives"
    annotation (Placement(transformation(extent={{306, 62}, {326, 82}}), iconTransformation(extent={{20, 90}, {40, 110}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b translationalSupport[1]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{354, 62}, {374, 82}}), iconTransformation(extent={{50, 90}, {70, 110}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b[4]
    "Frames of the links without children"
    annotation (Placement(transformation(extent={{420, -16}, {452, 16}}), iconTransformation(extent={{84, -16}, {116, 16}})));

  Links.Base_link base_link(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"base_link\""
    annotation (Placement(transformation(extent={{-72, -36}, {-52, -16}})));

  Links.Carousel carousel(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"carousel\""
    annotation (Placement(transformation(extent={{-24, -36}, {-4, -16}})));

  Links.Upper_arm upper_arm(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"upper_arm\""
    annotation (Placement(transformation(extent={{24, -36}, {44, -16}})));

  Links.Elbow_housing elbow_housing(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"elbow_housing\""
    annotation (Placement(transformation(extent={{72, -36}, {92, -16}})));

  Links.Forearm forearm(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"forearm\""
    annotation (Placement(transformation(extent={{120, -36}, {140, -16}})));

  Links.Wrist wrist(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"wrist\""
    annotation (Placement(transformation(extent={{168, -36}, {188, -16}})));

  Links.Mounting_flange mounting_flange(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"mounting_flange\""
    annotation (Placement(transformation(extent={{216, -36}, {236, -16}})));

  Links.Tool0 tool0(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"tool0\""
    annotation (Placement(transformation(extent={{264, -36}, {284, -16}})));

  Links.Gripper_body gripper_body(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"gripper_body\""
    annotation (Placement(transformation(extent={{312, -36}, {332, -16}})));

  Links.Finger_right finger_right(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"finger_right\""
    annotation (Placement(transformation(extent={{360, -36}, {380, -16}})));

  Links.Grasp_point grasp_point(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"grasp_point\""
    annotation (Placement(transformation(extent={{360, -98}, {380, -78}})));

  Links.Finger_left finger_left(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"finger_left\""
    annotation (Placement(transformation(extent={{360, -172}, {380, -152}})));

  Links.Drive_pinion drive_pinion(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"drive_pinion\""
    annotation (Placement(transformation(extent={{360, -262}, {380, -242}})));

  Joints.Turret turret(
    axisNumber = 1,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[1],
    w_start = w_start[1])
    "Revolute joint \"turret\" from link \"base_link\" to link \"carousel\""
    annotation (Placement(transformation(extent={{-56, -10}, {-36, 10}})));

  Joints.Shoulder shoulder(
    axisNumber = 2,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[2],
    w_start = w_start[2])
    "Revolute joint \"shoulder\" from link \"carousel\" to link \"upper_arm\""
    annotation (Placement(transformation(extent={{-8, -10}, {12, 10}})));

  Joints.Elbow elbow(
    axisNumber = 3,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[3],
    w_start = w_start[3])
    "Revolute joint \"elbow\" from link \"upper_arm\" to link \"elbow_housing\""
    annotation (Placement(transformation(extent={{40, -10}, {60, 10}})));

  Joints.Forearm_roll forearm_roll(
    axisNumber = 4,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[4],
    w_start = w_start[4])
    "Revolute joint \"forearm_roll\" from link \"elbow_housing\" to link \"forearm\""
    annotation (Placement(transformation(extent={{88, -10}, {108, 10}})));

  Joints.Wrist_pitch wrist_pitch(
    axisNumber = 5,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[5],
    w_start = w_start[5])
    "Revolute joint \"wrist_pitch\" from link \"forearm\" to link \"wrist\""
    annotation (Placement(transformation(extent={{136, -10}, {156, 10}})));

  Joints.Flange_roll flange_roll(
    axisNumber = 6,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[6],
    w_start = w_start[6])
    "Revolute joint \"flange_roll\" from link \"wrist\" to link \"mounting_flange\""
    annotation (Placement(transformation(extent={{184, -10}, {204, 10}})));

  Joints.Flange_to_tool flange_to_tool
    "Fixed joint \"flange_to_tool\" from link \"mounting_flange\" to link \"tool0\""
    annotation (Placement(transformation(extent={{232, -10}, {252, 10}})));

  Joints.Gripper_mount gripper_mount
    "Fixed joint \"gripper_mount\" from link \"tool0\" to link \"gripper_body\""
    annotation (Placement(transformation(extent={{280, -10}, {300, 10}})));

  Joints.Finger_coupling finger_coupling(
    checkLimits = checkLimits,
    checkEffort = false,
    stateSelect = StateSelect.avoid,
    fixedStart = false,
    s_start = finger_coupling.parameters.mimic.multiplier*gripper_stroke.s_start + finger_coupling.parameters.mimic.offset)
    "Prismatic joint \"finger_coupling\" from link \"gripper_body\" to link \"finger_right\""
    annotation (Placement(transformation(extent={{328, -10}, {348, 10}})));

  Joints.Grasp_frame grasp_frame
    "Fixed joint \"grasp_frame\" from link \"gripper_body\" to link \"grasp_point\""
    annotation (Placement(transformation(extent={{328, -72}, {348, -52}})));

  Joints.Gripper_stroke gripper_stroke(
    axisNumber = 1,
    checkLimits = checkLimits,
    checkEffort = false,
    fixedStart = fixedStart,
    s_start = s_start[1],
    v_start = v_start[1])
    "Prismatic joint \"gripper_stroke\" from link \"gripper_body\" to link \"finger_left\""
    annotation (Placement(transformation(extent={{328, -146}, {348, -126}})));

  Joints.Pinion_coupling pinion_coupling(
    checkLimits = checkLimits,
    checkEffort = false,
    stateSelect = StateSelect.avoid,
    fixedStart = false,
    phi_start = pinion_coupling.parameters.mimic.multiplier*gripper_stroke.s_start + pinion_coupling.parameters.mimic.offset)
    "Revolute joint \"pinion_coupling\" from link \"gripper_body\" to link \"drive_pinion\""
    annotation (Placement(transformation(extent={{328, -236}, {348, -216}})));

  UrdfSync.Couplings.TranslationalToTranslational finger_couplingMimic(parameters = finger_coupling.parameters.mimic)
    "Joint \"finger_coupling\" follows joint \"gripper_stroke\""
    annotation (Placement(transformation(extent={{312, 18}, {332, 38}})));

  UrdfSync.Couplings.TranslationalToRotational pinion_couplingMimic(parameters = pinion_coupling.parameters.mimic)
    "Joint \"pinion_coupling\" follows joint \"gripper_stroke\""
    annotation (Placement(transformation(extent={{312, -208}, {332, -188}})));

equation
  assert(not checkLimits or 0.999999*abs(translationalAxis[1].f) <= gripper_stroke.parameters.limits.effort + 1e-6,
    getInstanceName() + ".gripper_stroke (joint " + gripper_stroke.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  connect(frame_a, base_link.frame_a)
    annotation (Line(points={{-100, 0}, {-76, 0}, {-76, -26}, {-72, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, turret.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, 0}, {-56, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(turret.frame_b, carousel.frame_a)
    annotation (Line(points={{-36, 0}, {-28, 0}, {-28, -26}, {-24, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(carousel.frame_a, shoulder.frame_a)
    annotation (Line(points={{-24, -26}, {-28, -26}, {-28, 0}, {-8, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(shoulder.frame_b, upper_arm.frame_a)
    annotation (Line(points={{12, 0}, {20, 0}, {20, -26}, {24, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(upper_arm.frame_a, elbow.frame_a)
    annotation (Line(points={{24, -26}, {20, -26}, {20, 0}, {40, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow.frame_b, elbow_housing.frame_a)
    annotation (Line(points={{60, 0}, {68, 0}, {68, -26}, {72, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow_housing.frame_a, forearm_roll.frame_a)
    annotation (Line(points={{72, -26}, {68, -26}, {68, 0}, {88, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(forearm_roll.frame_b, forearm.frame_a)
    annotation (Line(points={{108, 0}, {116, 0}, {116, -26}, {120, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(forearm.frame_a, wrist_pitch.frame_a)
    annotation (Line(points={{120, -26}, {116, -26}, {116, 0}, {136, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(wrist_pitch.frame_b, wrist.frame_a)
    annotation (Line(points={{156, 0}, {164, 0}, {164, -26}, {168, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(wrist.frame_a, flange_roll.frame_a)
    annotation (Line(points={{168, -26}, {164, -26}, {164, 0}, {184, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(flange_roll.frame_b, mounting_flange.frame_a)
    annotation (Line(points={{204, 0}, {212, 0}, {212, -26}, {216, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(mounting_flange.frame_a, flange_to_tool.frame_a)
    annotation (Line(points={{216, -26}, {212, -26}, {212, 0}, {232, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(flange_to_tool.frame_b, tool0.frame_a)
    annotation (Line(points={{252, 0}, {260, 0}, {260, -26}, {264, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(tool0.frame_a, gripper_mount.frame_a)
    annotation (Line(points={{264, -26}, {260, -26}, {260, 0}, {280, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_mount.frame_b, gripper_body.frame_a)
    annotation (Line(points={{300, 0}, {308, 0}, {308, -26}, {312, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, finger_coupling.frame_a)
    annotation (Line(points={{312, -26}, {308, -26}, {308, 0}, {328, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(finger_coupling.frame_b, finger_right.frame_a)
    annotation (Line(points={{348, 0}, {356, 0}, {356, -26}, {360, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, grasp_frame.frame_a)
    annotation (Line(points={{312, -26}, {308, -26}, {308, -62}, {328, -62}}, color={95, 95, 95}, thickness=0.5));
  connect(grasp_frame.frame_b, grasp_point.frame_a)
    annotation (Line(points={{348, -62}, {356, -62}, {356, -88}, {360, -88}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, gripper_stroke.frame_a)
    annotation (Line(points={{312, -26}, {308, -26}, {308, -136}, {328, -136}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_stroke.frame_b, finger_left.frame_a)
    annotation (Line(points={{348, -136}, {356, -136}, {356, -162}, {360, -162}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, pinion_coupling.frame_a)
    annotation (Line(points={{312, -26}, {308, -26}, {308, -226}, {328, -226}}, color={95, 95, 95}, thickness=0.5));
  connect(pinion_coupling.frame_b, drive_pinion.frame_a)
    annotation (Line(points={{348, -226}, {356, -226}, {356, -252}, {360, -252}}, color={95, 95, 95}, thickness=0.5));
  connect(finger_right.frame_a, frame_b[1])
    annotation (Line(points={{360, -26}, {356, -26}, {356, 0}, {436, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(grasp_point.frame_a, frame_b[2])
    annotation (Line(points={{360, -88}, {356, -88}, {356, -62}, {412, -62}, {412, 0}, {436, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(finger_left.frame_a, frame_b[3])
    annotation (Line(points={{360, -162}, {356, -162}, {356, -136}, {412, -136}, {412, 0}, {436, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_pinion.frame_a, frame_b[4])
    annotation (Line(points={{360, -252}, {356, -252}, {356, -226}, {412, -226}, {412, 0}, {436, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(turret.axis, rotationalAxis[1])
    annotation (Line(points={{-46, 10}, {-46, 46}, {220, 46}, {220, 72}}, color={0, 0, 0}));
  connect(turret.support, rotationalSupport[1])
    annotation (Line(points={{-52, 10}, {-52, 50}, {268, 50}, {268, 72}}, color={0, 0, 0}));
  connect(shoulder.axis, rotationalAxis[2])
    annotation (Line(points={{2, 10}, {2, 46}, {220, 46}, {220, 72}}, color={0, 0, 0}));
  connect(shoulder.support, rotationalSupport[2])
    annotation (Line(points={{-4, 10}, {-4, 50}, {268, 50}, {268, 72}}, color={0, 0, 0}));
  connect(elbow.axis, rotationalAxis[3])
    annotation (Line(points={{50, 10}, {50, 46}, {220, 46}, {220, 72}}, color={0, 0, 0}));
  connect(elbow.support, rotationalSupport[3])
    annotation (Line(points={{44, 10}, {44, 50}, {268, 50}, {268, 72}}, color={0, 0, 0}));
  connect(forearm_roll.axis, rotationalAxis[4])
    annotation (Line(points={{98, 10}, {98, 46}, {220, 46}, {220, 72}}, color={0, 0, 0}));
  connect(forearm_roll.support, rotationalSupport[4])
    annotation (Line(points={{92, 10}, {92, 50}, {268, 50}, {268, 72}}, color={0, 0, 0}));
  connect(wrist_pitch.axis, rotationalAxis[5])
    annotation (Line(points={{146, 10}, {146, 46}, {220, 46}, {220, 72}}, color={0, 0, 0}));
  connect(wrist_pitch.support, rotationalSupport[5])
    annotation (Line(points={{140, 10}, {140, 50}, {268, 50}, {268, 72}}, color={0, 0, 0}));
  connect(flange_roll.axis, rotationalAxis[6])
    annotation (Line(points={{194, 10}, {194, 46}, {220, 46}, {220, 72}}, color={0, 0, 0}));
  connect(flange_roll.support, rotationalSupport[6])
    annotation (Line(points={{188, 10}, {188, 50}, {268, 50}, {268, 72}}, color={0, 0, 0}));
  connect(gripper_stroke.axis, translationalAxis[1])
    annotation (Line(points={{338, -126}, {338, -114}, {406, -114}, {406, 54}, {316, 54}, {316, 72}}, color={0, 127, 0}));
  connect(gripper_stroke.support, translationalSupport[1])
    annotation (Line(points={{332, -126}, {332, -110}, {400, -110}, {400, 58}, {364, 58}, {364, 72}}, color={0, 127, 0}));
  connect(finger_couplingMimic.follower, finger_coupling.axis)
    annotation (Line(points={{332, 28}, {338, 28}, {338, 10}}, color={0, 127, 0}));
  connect(finger_couplingMimic.leader, gripper_stroke.axis)
    annotation (Line(points={{312, 28}, {304, 28}, {304, -118}, {338, -118}, {338, -126}}, color={0, 127, 0}));
  connect(pinion_couplingMimic.follower, pinion_coupling.axis)
    annotation (Line(points={{332, -198}, {338, -198}, {338, -216}}, color={0, 0, 0}));
  connect(pinion_couplingMimic.leader, gripper_stroke.axis)
    annotation (Line(points={{312, -198}, {304, -198}, {304, -118}, {338, -118}, {338, -126}}, color={0, 127, 0}));

  annotation (
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -270}, {452, 82}})),
    Documentation(info="<html>
<p>
Links and joints of robot SixAxisArm, connected. The flange vectors hold the axes that can be driven; the constants <code>...Axis</code> and <code>...Frame</code> are their numbers, and keep their meaning when the robot changes. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end SixAxisArm;
