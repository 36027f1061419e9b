within UrdfSync.Examples.SixAxisArm;

model SixAxisArm "Robot SixAxisArm"
  extends UrdfSync.Robots.PartialStationaryRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b tool0Frame
    "Frame of link \"tool0\""
    annotation (Placement(transformation(extent={{364, -54}, {376, -42}}), iconTransformation(extent={{92, 132}, {108, 148}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b finger_rightFrame
    "Frame of link \"finger_right\""
    annotation (Placement(transformation(extent={{496, -10}, {516, 10}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b grasp_pointFrame
    "Frame of link \"grasp_point\""
    annotation (Placement(transformation(extent={{496, -388}, {516, -368}}), iconTransformation(extent={{92, 172}, {108, 188}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b finger_leftFrame
    "Frame of link \"finger_left\""
    annotation (Placement(transformation(extent={{496, -136}, {516, -116}}), iconTransformation(extent={{92, 192}, {108, 208}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b drive_pinionFrame
    "Frame of link \"drive_pinion\""
    annotation (Placement(transformation(extent={{496, -262}, {516, -242}}), iconTransformation(extent={{92, 152}, {108, 168}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a turretAxis
    "Axis of joint \"turret\""
    annotation (Placement(transformation(extent={{-40, 14}, {-28, 26}}), iconTransformation(extent={{-104, 316}, {-96, 324}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b turretSupport
    "Housing of the drive of joint \"turret\""
    annotation (Placement(transformation(extent={{-54, 14}, {-42, 26}}), iconTransformation(extent={{-104, 306}, {-96, 314}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a shoulderAxis
    "Axis of joint \"shoulder\""
    annotation (Placement(transformation(extent={{20, 14}, {32, 26}}), iconTransformation(extent={{-104, 176}, {-96, 184}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b shoulderSupport
    "Housing of the drive of joint \"shoulder\""
    annotation (Placement(transformation(extent={{6, 14}, {18, 26}}), iconTransformation(extent={{-104, 166}, {-96, 174}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a elbowAxis
    "Axis of joint \"elbow\""
    annotation (Placement(transformation(extent={{80, 14}, {92, 26}}), iconTransformation(extent={{-104, 256}, {-96, 264}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b elbowSupport
    "Housing of the drive of joint \"elbow\""
    annotation (Placement(transformation(extent={{66, 14}, {78, 26}}), iconTransformation(extent={{-104, 246}, {-96, 254}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a forearm_rollAxis
    "Axis of joint \"forearm_roll\""
    annotation (Placement(transformation(extent={{140, 14}, {152, 26}}), iconTransformation(extent={{-104, 216}, {-96, 224}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b forearm_rollSupport
    "Housing of the drive of joint \"forearm_roll\""
    annotation (Placement(transformation(extent={{126, 14}, {138, 26}}), iconTransformation(extent={{-104, 206}, {-96, 214}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a wrist_pitchAxis
    "Axis of joint \"wrist_pitch\""
    annotation (Placement(transformation(extent={{200, 14}, {212, 26}}), iconTransformation(extent={{-104, 136}, {-96, 144}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b wrist_pitchSupport
    "Housing of the drive of joint \"wrist_pitch\""
    annotation (Placement(transformation(extent={{186, 14}, {198, 26}}), iconTransformation(extent={{-104, 126}, {-96, 134}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a flange_rollAxis
    "Axis of joint \"flange_roll\""
    annotation (Placement(transformation(extent={{260, 14}, {272, 26}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b flange_rollSupport
    "Housing of the drive of joint \"flange_roll\""
    annotation (Placement(transformation(extent={{246, 14}, {258, 26}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a gripper_strokeAxis
    "Axis of joint \"gripper_stroke\""
    annotation (Placement(transformation(extent={{440, -112}, {452, -100}}), iconTransformation(extent={{-104, 156}, {-96, 164}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b gripper_strokeSupport
    "Housing of the drive of joint \"gripper_stroke\""
    annotation (Placement(transformation(extent={{426, -112}, {438, -100}}), iconTransformation(extent={{-104, 146}, {-96, 154}})));

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
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-60, -36}, {-40, -16}})));

  replaceable Links.Carousel carousel(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"carousel\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -36}, {20, -16}})));

  replaceable Links.Upper_arm upper_arm(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"upper_arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -36}, {80, -16}})));

  replaceable Links.Elbow_housing elbow_housing(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"elbow_housing\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{120, -36}, {140, -16}})));

  replaceable Links.Forearm forearm(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"forearm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{180, -36}, {200, -16}})));

  replaceable Links.Wrist wrist(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"wrist\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{240, -36}, {260, -16}})));

  replaceable Links.Mounting_flange mounting_flange(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"mounting_flange\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{300, -36}, {320, -16}})));

  replaceable Links.Tool0 tool0(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"tool0\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{360, -36}, {380, -16}})));

  replaceable Links.Gripper_body gripper_body(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"gripper_body\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{420, -36}, {440, -16}})));

  replaceable Links.Finger_right finger_right(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"finger_right\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{480, -36}, {500, -16}})));

  replaceable Links.Grasp_point grasp_point(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"grasp_point\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{480, -414}, {500, -394}})));

  replaceable Links.Finger_left finger_left(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"finger_left\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{480, -162}, {500, -142}})));

  replaceable Links.Drive_pinion drive_pinion(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"drive_pinion\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{480, -288}, {500, -268}})));

  replaceable Joints.Turret turret(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"turret\" from link \"base_link\" to link \"carousel\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -10}, {-24, 10}})));

  replaceable Joints.Shoulder shoulder(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"shoulder\" from link \"carousel\" to link \"upper_arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -10}, {36, 10}})));

  replaceable Joints.Elbow elbow(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"elbow\" from link \"upper_arm\" to link \"elbow_housing\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{76, -10}, {96, 10}})));

  replaceable Joints.Forearm_roll forearm_roll(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"forearm_roll\" from link \"elbow_housing\" to link \"forearm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{136, -10}, {156, 10}})));

  replaceable Joints.Wrist_pitch wrist_pitch(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"wrist_pitch\" from link \"forearm\" to link \"wrist\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{196, -10}, {216, 10}})));

  replaceable Joints.Flange_roll flange_roll(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"flange_roll\" from link \"wrist\" to link \"mounting_flange\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{256, -10}, {276, 10}})));

  replaceable Joints.Flange_to_tool flange_to_tool constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"flange_to_tool\" from link \"mounting_flange\" to link \"tool0\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{316, -10}, {336, 10}})));

  replaceable Joints.Gripper_mount gripper_mount constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"gripper_mount\" from link \"tool0\" to link \"gripper_body\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{376, -10}, {396, 10}})));

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
    annotation (choicesAllMatching=true, Placement(transformation(extent={{436, -10}, {456, 10}})));

  replaceable Joints.Grasp_frame grasp_frame constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"grasp_frame\" from link \"gripper_body\" to link \"grasp_point\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{436, -388}, {456, -368}})));

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
    annotation (choicesAllMatching=true, Placement(transformation(extent={{436, -136}, {456, -116}})));

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
    annotation (choicesAllMatching=true, Placement(transformation(extent={{436, -262}, {456, -242}})));

  UrdfSync.Couplings.TranslationalToTranslational finger_couplingMimic(
    s_min = finger_coupling.s_min,
    s_max = finger_coupling.s_max,
    v_max = finger_coupling.v_max,
    parameters = finger_coupling.parameters.mimic)
    "Joint \"finger_coupling\" follows joint \"gripper_stroke\""
    annotation (Placement(transformation(extent={{420, 34}, {440, 54}})));

  UrdfSync.Couplings.TranslationalToRotational pinion_couplingMimic(
    phi_min = pinion_coupling.phi_min,
    phi_max = pinion_coupling.phi_max,
    w_max = pinion_coupling.w_max,
    parameters = pinion_coupling.parameters.mimic)
    "Joint \"pinion_coupling\" follows joint \"gripper_stroke\""
    annotation (Placement(transformation(extent={{420, -218}, {440, -198}})));

equation
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(gripper_strokeAxis.f), gripper_stroke.parameters.limits.effort)),
    getInstanceName() + ".gripper_stroke (joint " + gripper_stroke.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  connect(frame_a, base_link.frame_a)
    annotation (Line(points={{-100, 0}, {-64, 0}, {-64, -26}, {-60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, turret.frame_a)
    annotation (Line(points={{-60, -26}, {-64, -26}, {-64, 0}, {-44, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(turret.frame_b, carousel.frame_a)
    annotation (Line(points={{-24, 0}, {-4, 0}, {-4, -26}, {0, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(carousel.frame_a, shoulder.frame_a)
    annotation (Line(points={{0, -26}, {-4, -26}, {-4, 0}, {16, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(shoulder.frame_b, upper_arm.frame_a)
    annotation (Line(points={{36, 0}, {56, 0}, {56, -26}, {60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(upper_arm.frame_a, elbow.frame_a)
    annotation (Line(points={{60, -26}, {56, -26}, {56, 0}, {76, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow.frame_b, elbow_housing.frame_a)
    annotation (Line(points={{96, 0}, {116, 0}, {116, -26}, {120, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow_housing.frame_a, forearm_roll.frame_a)
    annotation (Line(points={{120, -26}, {116, -26}, {116, 0}, {136, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(forearm_roll.frame_b, forearm.frame_a)
    annotation (Line(points={{156, 0}, {176, 0}, {176, -26}, {180, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(forearm.frame_a, wrist_pitch.frame_a)
    annotation (Line(points={{180, -26}, {176, -26}, {176, 0}, {196, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(wrist_pitch.frame_b, wrist.frame_a)
    annotation (Line(points={{216, 0}, {236, 0}, {236, -26}, {240, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(wrist.frame_a, flange_roll.frame_a)
    annotation (Line(points={{240, -26}, {236, -26}, {236, 0}, {256, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(flange_roll.frame_b, mounting_flange.frame_a)
    annotation (Line(points={{276, 0}, {296, 0}, {296, -26}, {300, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(mounting_flange.frame_a, flange_to_tool.frame_a)
    annotation (Line(points={{300, -26}, {296, -26}, {296, 0}, {316, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(flange_to_tool.frame_b, tool0.frame_a)
    annotation (Line(points={{336, 0}, {356, 0}, {356, -26}, {360, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(tool0.frame_a, tool0Frame)
    annotation (Line(points={{360, -26}, {356, -26}, {356, -48}, {370, -48}}, color={95, 95, 95}, thickness=0.5));
  connect(tool0.frame_a, gripper_mount.frame_a)
    annotation (Line(points={{360, -26}, {356, -26}, {356, 0}, {376, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_mount.frame_b, gripper_body.frame_a)
    annotation (Line(points={{396, 0}, {416, 0}, {416, -26}, {420, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, finger_coupling.frame_a)
    annotation (Line(points={{420, -26}, {416, -26}, {416, 0}, {436, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(finger_coupling.frame_b, finger_right.frame_a)
    annotation (Line(points={{456, 0}, {476, 0}, {476, -26}, {480, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, grasp_frame.frame_a)
    annotation (Line(points={{420, -26}, {412, -26}, {412, -378}, {436, -378}}, color={95, 95, 95}, thickness=0.5));
  connect(grasp_frame.frame_b, grasp_point.frame_a)
    annotation (Line(points={{456, -378}, {476, -378}, {476, -404}, {480, -404}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, gripper_stroke.frame_a)
    annotation (Line(points={{420, -26}, {412, -26}, {412, -126}, {436, -126}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_stroke.frame_b, finger_left.frame_a)
    annotation (Line(points={{456, -126}, {476, -126}, {476, -152}, {480, -152}}, color={95, 95, 95}, thickness=0.5));
  connect(gripper_body.frame_a, pinion_coupling.frame_a)
    annotation (Line(points={{420, -26}, {412, -26}, {412, -252}, {436, -252}}, color={95, 95, 95}, thickness=0.5));
  connect(pinion_coupling.frame_b, drive_pinion.frame_a)
    annotation (Line(points={{456, -252}, {476, -252}, {476, -278}, {480, -278}}, color={95, 95, 95}, thickness=0.5));
  connect(finger_right.frame_a, finger_rightFrame)
    annotation (Line(points={{480, -26}, {476, -26}, {476, 0}, {506, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(grasp_point.frame_a, grasp_pointFrame)
    annotation (Line(points={{480, -404}, {476, -404}, {476, -378}, {506, -378}}, color={95, 95, 95}, thickness=0.5));
  connect(finger_left.frame_a, finger_leftFrame)
    annotation (Line(points={{480, -152}, {476, -152}, {476, -126}, {506, -126}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_pinion.frame_a, drive_pinionFrame)
    annotation (Line(points={{480, -278}, {476, -278}, {476, -252}, {506, -252}}, color={95, 95, 95}, thickness=0.5));
  connect(turret.axis, turretAxis)
    annotation (Line(points={{-34, 10}, {-34, 20}}, color={0, 0, 0}));
  connect(turret.support, turretSupport)
    annotation (Line(points={{-40, 10}, {-40, 12}, {-48, 12}, {-48, 20}}, color={0, 0, 0}));
  connect(shoulder.axis, shoulderAxis)
    annotation (Line(points={{26, 10}, {26, 20}}, color={0, 0, 0}));
  connect(shoulder.support, shoulderSupport)
    annotation (Line(points={{20, 10}, {20, 12}, {12, 12}, {12, 20}}, color={0, 0, 0}));
  connect(elbow.axis, elbowAxis)
    annotation (Line(points={{86, 10}, {86, 20}}, color={0, 0, 0}));
  connect(elbow.support, elbowSupport)
    annotation (Line(points={{80, 10}, {80, 12}, {72, 12}, {72, 20}}, color={0, 0, 0}));
  connect(forearm_roll.axis, forearm_rollAxis)
    annotation (Line(points={{146, 10}, {146, 20}}, color={0, 0, 0}));
  connect(forearm_roll.support, forearm_rollSupport)
    annotation (Line(points={{140, 10}, {140, 12}, {132, 12}, {132, 20}}, color={0, 0, 0}));
  connect(wrist_pitch.axis, wrist_pitchAxis)
    annotation (Line(points={{206, 10}, {206, 20}}, color={0, 0, 0}));
  connect(wrist_pitch.support, wrist_pitchSupport)
    annotation (Line(points={{200, 10}, {200, 12}, {192, 12}, {192, 20}}, color={0, 0, 0}));
  connect(flange_roll.axis, flange_rollAxis)
    annotation (Line(points={{266, 10}, {266, 20}}, color={0, 0, 0}));
  connect(flange_roll.support, flange_rollSupport)
    annotation (Line(points={{260, 10}, {260, 12}, {252, 12}, {252, 20}}, color={0, 0, 0}));
  connect(gripper_stroke.axis, gripper_strokeAxis)
    annotation (Line(points={{446, -116}, {446, -106}}, color={0, 127, 0}));
  connect(gripper_stroke.support, gripper_strokeSupport)
    annotation (Line(points={{440, -116}, {440, -114}, {432, -114}, {432, -106}}, color={0, 127, 0}));
  connect(finger_couplingMimic.follower, finger_coupling.axis)
    annotation (Line(points={{440, 44}, {446, 44}, {446, 10}}, color={0, 127, 0}));
  connect(finger_couplingMimic.leader, gripper_stroke.axis)
    annotation (Line(points={{420, 44}, {408, 44}, {408, -64}, {454, -64}, {454, -114}, {446, -114}, {446, -116}}, color={0, 127, 0}));
  connect(pinion_couplingMimic.follower, pinion_coupling.axis)
    annotation (Line(points={{440, -208}, {446, -208}, {446, -242}}, color={0, 0, 0}));
  connect(pinion_couplingMimic.leader, gripper_stroke.axis)
    annotation (Line(points={{420, -208}, {408, -208}, {408, -64}, {454, -64}, {454, -114}, {446, -114}, {446, -116}}, color={0, 127, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 330}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 330}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 306}, {0, 324}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="turret"),
      Text(extent={{-90, 166}, {0, 184}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="shoulder"),
      Text(extent={{-90, 246}, {0, 264}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="elbow"),
      Text(extent={{-90, 206}, {0, 224}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="forearm_roll"),
      Text(extent={{-90, 126}, {0, 144}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="wrist_pitch"),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="flange_roll"),
      Text(extent={{-90, 146}, {0, 164}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="gripper_stroke"),
      Text(extent={{0, 133}, {88, 147}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="tool0"),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="finger_right"),
      Text(extent={{0, 173}, {88, 187}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="grasp_point"),
      Text(extent={{0, 193}, {88, 207}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="finger_left"),
      Text(extent={{0, 153}, {88, 167}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="drive_pinion")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -438}, {540, 66}})),
    Documentation(info="<html>
<p>
Links and joints of robot SixAxisArm, connected. Each can be exchanged in a model that extends this one. Each joint that can be driven has two flanges for its drive: its name with <code>Axis</code> and with <code>Support</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-3d0d", base = "c8c871a00a874953"));
end SixAxisArm;
