within UrdfSync.Examples.SixAxisArm;

model SixAxisArm "Robot SixAxisArm"
  extends UrdfSync.Robots.PartialStationaryRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b tool0Frame
    "Frame of link \"tool0\""
    annotation (Placement(transformation(extent={{268, -54}, {280, -42}}), iconTransformation(extent={{92, 232}, {108, 248}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b finger_rightFrame
    "Frame of link \"finger_right\""
    annotation (Placement(transformation(extent={{376, -10}, {396, 10}}), iconTransformation(extent={{92, 212}, {108, 228}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b grasp_pointFrame
    "Frame of link \"grasp_point\""
    annotation (Placement(transformation(extent={{376, -88}, {396, -68}}), iconTransformation(extent={{92, 192}, {108, 208}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b finger_leftFrame
    "Frame of link \"finger_left\""
    annotation (Placement(transformation(extent={{376, -170}, {396, -150}}), iconTransformation(extent={{92, 172}, {108, 188}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b drive_pinionFrame
    "Frame of link \"drive_pinion\""
    annotation (Placement(transformation(extent={{376, -260}, {396, -240}}), iconTransformation(extent={{92, 152}, {108, 168}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a turretAxis
    "Axis of joint \"turret\""
    annotation (Placement(transformation(extent={{-52, 14}, {-40, 26}}), iconTransformation(extent={{-104, 236}, {-96, 244}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b turretSupport
    "Housing of the drive of joint \"turret\""
    annotation (Placement(transformation(extent={{-66, 14}, {-54, 26}}), iconTransformation(extent={{-104, 226}, {-96, 234}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a shoulderAxis
    "Axis of joint \"shoulder\""
    annotation (Placement(transformation(extent={{-4, 14}, {8, 26}}), iconTransformation(extent={{-104, 216}, {-96, 224}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b shoulderSupport
    "Housing of the drive of joint \"shoulder\""
    annotation (Placement(transformation(extent={{-18, 14}, {-6, 26}}), iconTransformation(extent={{-104, 206}, {-96, 214}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a elbowAxis
    "Axis of joint \"elbow\""
    annotation (Placement(transformation(extent={{44, 14}, {56, 26}}), iconTransformation(extent={{-104, 196}, {-96, 204}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b elbowSupport
    "Housing of the drive of joint \"elbow\""
    annotation (Placement(transformation(extent={{30, 14}, {42, 26}}), iconTransformation(extent={{-104, 186}, {-96, 194}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a forearm_rollAxis
    "Axis of joint \"forearm_roll\""
    annotation (Placement(transformation(extent={{92, 14}, {104, 26}}), iconTransformation(extent={{-104, 176}, {-96, 184}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b forearm_rollSupport
    "Housing of the drive of joint \"forearm_roll\""
    annotation (Placement(transformation(extent={{78, 14}, {90, 26}}), iconTransformation(extent={{-104, 166}, {-96, 174}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a wrist_pitchAxis
    "Axis of joint \"wrist_pitch\""
    annotation (Placement(transformation(extent={{140, 14}, {152, 26}}), iconTransformation(extent={{-104, 156}, {-96, 164}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b wrist_pitchSupport
    "Housing of the drive of joint \"wrist_pitch\""
    annotation (Placement(transformation(extent={{126, 14}, {138, 26}}), iconTransformation(extent={{-104, 146}, {-96, 154}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a flange_rollAxis
    "Axis of joint \"flange_roll\""
    annotation (Placement(transformation(extent={{188, 14}, {200, 26}}), iconTransformation(extent={{-104, 136}, {-96, 144}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b flange_rollSupport
    "Housing of the drive of joint \"flange_roll\""
    annotation (Placement(transformation(extent={{174, 14}, {186, 26}}), iconTransformation(extent={{-104, 126}, {-96, 134}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a gripper_strokeAxis
    "Axis of joint \"gripper_stroke\""
    annotation (Placement(transformation(extent={{332, -146}, {344, -134}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b gripper_strokeSupport
    "Housing of the drive of joint \"gripper_stroke\""
    annotation (Placement(transformation(extent={{318, -146}, {330, -134}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

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

  replaceable Links.Base_link base_link(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"base_link\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-72, -36}, {-52, -16}})));

  replaceable Links.Carousel carousel(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"carousel\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-24, -36}, {-4, -16}})));

  replaceable Links.Upper_arm upper_arm(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"upper_arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{24, -36}, {44, -16}})));

  replaceable Links.Elbow_housing elbow_housing(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"elbow_housing\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{72, -36}, {92, -16}})));

  replaceable Links.Forearm forearm(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"forearm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{120, -36}, {140, -16}})));

  replaceable Links.Wrist wrist(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"wrist\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{168, -36}, {188, -16}})));

  replaceable Links.Mounting_flange mounting_flange(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"mounting_flange\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{216, -36}, {236, -16}})));

  replaceable Links.Tool0 tool0(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"tool0\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{264, -36}, {284, -16}})));

  replaceable Links.Gripper_body gripper_body(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"gripper_body\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{312, -36}, {332, -16}})));

  replaceable Links.Finger_right finger_right(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"finger_right\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{360, -36}, {380, -16}})));

  replaceable Links.Grasp_point grasp_point(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"grasp_point\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{360, -114}, {380, -94}})));

  replaceable Links.Finger_left finger_left(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"finger_left\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{360, -196}, {380, -176}})));

  replaceable Links.Drive_pinion drive_pinion(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"drive_pinion\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{360, -286}, {380, -266}})));

  replaceable Joints.Turret turret(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"turret\" from link \"base_link\" to link \"carousel\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -10}, {-36, 10}})));

  replaceable Joints.Shoulder shoulder(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"shoulder\" from link \"carousel\" to link \"upper_arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-8, -10}, {12, 10}})));

  replaceable Joints.Elbow elbow(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"elbow\" from link \"upper_arm\" to link \"elbow_housing\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{40, -10}, {60, 10}})));

  replaceable Joints.Forearm_roll forearm_roll(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"forearm_roll\" from link \"elbow_housing\" to link \"forearm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{88, -10}, {108, 10}})));

  replaceable Joints.Wrist_pitch wrist_pitch(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"wrist_pitch\" from link \"forearm\" to link \"wrist\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{136, -10}, {156, 10}})));

  replaceable Joints.Flange_roll flange_roll(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"flange_roll\" from link \"wrist\" to link \"mounting_flange\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{184, -10}, {204, 10}})));

  replaceable Joints.Flange_to_tool flange_to_tool constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"flange_to_tool\" from link \"mounting_flange\" to link \"tool0\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{232, -10}, {252, 10}})));

  replaceable Joints.Gripper_mount gripper_mount constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"gripper_mount\" from link \"tool0\" to link \"gripper_body\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{280, -10}, {300, 10}})));

  replaceable Joints.Finger_coupling finger_coupling(
    s_start = finger_coupling.parameters.mimic.multiplier*gripper_stroke.s_start + finger_coupling.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_start = finger_coupling.parameters.mimic.multiplier*gripper_stroke.s_start + finger_coupling.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Prismatic joint \"finger_coupling\" from link \"gripper_body\" to link \"finger_right\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{328, -10}, {348, 10}})));

  replaceable Joints.Grasp_frame grasp_frame constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"grasp_frame\" from link \"gripper_body\" to link \"grasp_point\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{328, -88}, {348, -68}})));

  replaceable Joints.Gripper_stroke gripper_stroke(
    s_min = max({gripper_stroke.parameters.limits.lower, finger_couplingMimic.leader_min, pinion_couplingMimic.leader_min}),
    s_max = min({gripper_stroke.parameters.limits.upper, finger_couplingMimic.leader_max, pinion_couplingMimic.leader_max}),
    v_max = min({gripper_stroke.parameters.limits.velocity, finger_couplingMimic.leaderSpeed_max, pinion_couplingMimic.leaderSpeed_max}),
    fixedStart = fixedStart,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_min = max({gripper_stroke.parameters.limits.lower, finger_couplingMimic.leader_min, pinion_couplingMimic.leader_min}),
      s_max = min({gripper_stroke.parameters.limits.upper, finger_couplingMimic.leader_max, pinion_couplingMimic.leader_max}),
      v_max = min({gripper_stroke.parameters.limits.velocity, finger_couplingMimic.leaderSpeed_max, pinion_couplingMimic.leaderSpeed_max}),
      fixedStart = fixedStart,
      checkEffort = false,
      checkLimits = checkLimits)
    "Prismatic joint \"gripper_stroke\" from link \"gripper_body\" to link \"finger_left\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{328, -170}, {348, -150}})));

  replaceable Joints.Pinion_coupling pinion_coupling(
    phi_start = pinion_coupling.parameters.mimic.multiplier*gripper_stroke.s_start + pinion_coupling.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = pinion_coupling.parameters.mimic.multiplier*gripper_stroke.s_start + pinion_coupling.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Revolute joint \"pinion_coupling\" from link \"gripper_body\" to link \"drive_pinion\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{328, -260}, {348, -240}})));

  UrdfSync.Couplings.TranslationalToTranslational finger_couplingMimic(
    s_min = finger_coupling.s_min,
    s_max = finger_coupling.s_max,
    v_max = finger_coupling.v_max,
    parameters = finger_coupling.parameters.mimic)
    "Joint \"finger_coupling\" follows joint \"gripper_stroke\""
    annotation (Placement(transformation(extent={{312, 34}, {332, 54}})));

  UrdfSync.Couplings.TranslationalToRotational pinion_couplingMimic(
    phi_min = pinion_coupling.phi_min,
    phi_max = pinion_coupling.phi_max,
    w_max = pinion_coupling.w_max,
    parameters = pinion_coupling.parameters.mimic)
    "Joint \"pinion_coupling\" follows joint \"gripper_stroke\""
    annotation (Placement(transformation(extent={{312, -232}, {332, -212}})));

equation
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(gripper_strokeAxis.f), gripper_stroke.parameters.limits.effort)),
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
  connect(tool0.frame_a, tool0Frame)
    annotation (Line(points={{264, -26}, {260, -26}, {260, -48}, {274, -48}}, color={95, 95, 95}, thickness=0.5));
  connect(tool0.frame_a, gripper_mount.frame_a)
    annotation (Line(points={{264, -26}, {260, -26}, {260, 0}, {280, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_mount.frame_b, gripper_body.frame_a)
    annotation (Line(points={{300, 0}, {308, 0}, {308, -26}, {312, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, finger_coupling.frame_a)
    annotation (Line(points={{312, -26}, {308, -26}, {308, 0}, {328, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(finger_coupling.frame_b, finger_right.frame_a)
    annotation (Line(points={{348, 0}, {356, 0}, {356, -26}, {360, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, grasp_frame.frame_a)
    annotation (Line(points={{312, -26}, {308, -26}, {308, -78}, {328, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(grasp_frame.frame_b, grasp_point.frame_a)
    annotation (Line(points={{348, -78}, {356, -78}, {356, -104}, {360, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, gripper_stroke.frame_a)
    annotation (Line(points={{312, -26}, {308, -26}, {308, -160}, {328, -160}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_stroke.frame_b, finger_left.frame_a)
    annotation (Line(points={{348, -160}, {356, -160}, {356, -186}, {360, -186}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, pinion_coupling.frame_a)
    annotation (Line(points={{312, -26}, {308, -26}, {308, -250}, {328, -250}}, color={95, 95, 95}, thickness=0.5));
  connect(pinion_coupling.frame_b, drive_pinion.frame_a)
    annotation (Line(points={{348, -250}, {356, -250}, {356, -276}, {360, -276}}, color={95, 95, 95}, thickness=0.5));
  connect(finger_right.frame_a, finger_rightFrame)
    annotation (Line(points={{360, -26}, {356, -26}, {356, 0}, {386, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(grasp_point.frame_a, grasp_pointFrame)
    annotation (Line(points={{360, -104}, {356, -104}, {356, -78}, {386, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(finger_left.frame_a, finger_leftFrame)
    annotation (Line(points={{360, -186}, {356, -186}, {356, -160}, {386, -160}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_pinion.frame_a, drive_pinionFrame)
    annotation (Line(points={{360, -276}, {356, -276}, {356, -250}, {386, -250}}, color={95, 95, 95}, thickness=0.5));
  connect(turret.axis, turretAxis)
    annotation (Line(points={{-46, 10}, {-46, 20}}, color={0, 0, 0}));
  connect(turret.support, turretSupport)
    annotation (Line(points={{-52, 10}, {-52, 12}, {-60, 12}, {-60, 20}}, color={0, 0, 0}));
  connect(shoulder.axis, shoulderAxis)
    annotation (Line(points={{2, 10}, {2, 20}}, color={0, 0, 0}));
  connect(shoulder.support, shoulderSupport)
    annotation (Line(points={{-4, 10}, {-4, 12}, {-12, 12}, {-12, 20}}, color={0, 0, 0}));
  connect(elbow.axis, elbowAxis)
    annotation (Line(points={{50, 10}, {50, 20}}, color={0, 0, 0}));
  connect(elbow.support, elbowSupport)
    annotation (Line(points={{44, 10}, {44, 12}, {36, 12}, {36, 20}}, color={0, 0, 0}));
  connect(forearm_roll.axis, forearm_rollAxis)
    annotation (Line(points={{98, 10}, {98, 20}}, color={0, 0, 0}));
  connect(forearm_roll.support, forearm_rollSupport)
    annotation (Line(points={{92, 10}, {92, 12}, {84, 12}, {84, 20}}, color={0, 0, 0}));
  connect(wrist_pitch.axis, wrist_pitchAxis)
    annotation (Line(points={{146, 10}, {146, 20}}, color={0, 0, 0}));
  connect(wrist_pitch.support, wrist_pitchSupport)
    annotation (Line(points={{140, 10}, {140, 12}, {132, 12}, {132, 20}}, color={0, 0, 0}));
  connect(flange_roll.axis, flange_rollAxis)
    annotation (Line(points={{194, 10}, {194, 20}}, color={0, 0, 0}));
  connect(flange_roll.support, flange_rollSupport)
    annotation (Line(points={{188, 10}, {188, 12}, {180, 12}, {180, 20}}, color={0, 0, 0}));
  connect(gripper_stroke.axis, gripper_strokeAxis)
    annotation (Line(points={{338, -150}, {338, -140}}, color={0, 127, 0}));
  connect(gripper_stroke.support, gripper_strokeSupport)
    annotation (Line(points={{332, -150}, {332, -148}, {324, -148}, {324, -140}}, color={0, 127, 0}));
  connect(finger_couplingMimic.follower, finger_coupling.axis)
    annotation (Line(points={{332, 44}, {338, 44}, {338, 10}}, color={0, 127, 0}));
  connect(finger_couplingMimic.leader, gripper_stroke.axis)
    annotation (Line(points={{312, 44}, {304, 44}, {304, -126}, {346, -126}, {346, -148}, {338, -148}, {338, -150}}, color={0, 127, 0}));
  connect(pinion_couplingMimic.follower, pinion_coupling.axis)
    annotation (Line(points={{332, -222}, {338, -222}, {338, -240}}, color={0, 0, 0}));
  connect(pinion_couplingMimic.leader, gripper_stroke.axis)
    annotation (Line(points={{312, -222}, {304, -222}, {304, -126}, {346, -126}, {346, -148}, {338, -148}, {338, -150}}, color={0, 127, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 250}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 250}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 226}, {0, 244}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="turret"),
      Text(extent={{-90, 206}, {0, 224}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="shoulder"),
      Text(extent={{-90, 186}, {0, 204}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="elbow"),
      Text(extent={{-90, 166}, {0, 184}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="forearm_roll"),
      Text(extent={{-90, 146}, {0, 164}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="wrist_pitch"),
      Text(extent={{-90, 126}, {0, 144}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="flange_roll"),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="gripper_stroke"),
      Text(extent={{0, 233}, {88, 247}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="tool0"),
      Text(extent={{0, 213}, {88, 227}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="finger_right"),
      Text(extent={{0, 193}, {88, 207}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="grasp_point"),
      Text(extent={{0, 173}, {88, 187}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="finger_left"),
      Text(extent={{0, 153}, {88, 167}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="drive_pinion")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -294}, {420, 62}})),
    Documentation(info="<html>
<p>
Links and joints of robot SixAxisArm, connected. Each can be exchanged in a model that extends this one. A drive of joint <code>elbow</code>, say, is connected to <code>elbowAxis</code> and <code>elbowSupport</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end SixAxisArm;
