within Zoo.Menagerie;

model Menagerie "Robot Menagerie"
  extends UrdfSync.Robots.PartialMobileRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b end_linkFrame
    "Frame of link \"end\""
    annotation (Placement(transformation(extent={{44, -10}, {64, 10}}), iconTransformation(extent={{92, 272}, {108, 288}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b pinionFrame
    "Frame of link \"pinion\""
    annotation (Placement(transformation(extent={{44, -100}, {64, -80}}), iconTransformation(extent={{92, 252}, {108, 268}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b gelenk__Frame
    "Frame of link \"Gelenk_ä\""
    annotation (Placement(transformation(extent={{44, -190}, {64, -170}}), iconTransformation(extent={{92, 232}, {108, 248}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b time_linkFrame
    "Frame of link \"time\""
    annotation (Placement(transformation(extent={{44, -280}, {64, -260}}), iconTransformation(extent={{92, 212}, {108, 228}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b cON_linkFrame
    "Frame of link \"CON\""
    annotation (Placement(transformation(extent={{-4, -358}, {16, -338}}), iconTransformation(extent={{92, 192}, {108, 208}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b l_arm_linkFrame
    "Frame of link \"L_arm\""
    annotation (Placement(transformation(extent={{44, -468}, {64, -448}}), iconTransformation(extent={{92, 172}, {108, 188}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b nutFrame
    "Frame of link \"nut\""
    annotation (Placement(transformation(extent={{44, -558}, {64, -538}}), iconTransformation(extent={{92, 152}, {108, 168}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b a_b___c_______1_0______d____eFrame
    "Frame of link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
    annotation (Placement(transformation(extent={{44, -620}, {64, -600}}), iconTransformation(extent={{92, 132}, {108, 148}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b balloonFrame
    "Frame of link \"balloon\""
    annotation (Placement(transformation(extent={{-4, -682}, {16, -662}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a liftAxis
    "Axis of joint \"lift\""
    annotation (Placement(transformation(extent={{-52, 14}, {-40, 26}}), iconTransformation(extent={{-104, 156}, {-96, 164}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b liftSupport
    "Housing of the drive of joint \"lift\""
    annotation (Placement(transformation(extent={{-66, 14}, {-54, 26}}), iconTransformation(extent={{-104, 146}, {-96, 154}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a rotationalAxis_2
    "Axis of joint \"rotational\""
    annotation (Placement(transformation(extent={{-52, -334}, {-40, -322}}), iconTransformation(extent={{-104, 136}, {-96, 144}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rotationalSupport_2
    "Housing of the drive of joint \"rotational\""
    annotation (Placement(transformation(extent={{-66, -334}, {-54, -322}}), iconTransformation(extent={{-104, 126}, {-96, 134}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a shoulderAxis
    "Axis of joint \"shoulder\""
    annotation (Placement(transformation(extent={{-52, -444}, {-40, -432}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b shoulderSupport
    "Housing of the drive of joint \"shoulder\""
    annotation (Placement(transformation(extent={{-66, -444}, {-54, -432}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

  final parameter Modelica.Units.SI.Mass m =
    chassis.m +
    l_arm.m +
    end_link.m +
    pinion.m +
    name_link.m +
    gelenk__.m +
    time_link.m +
    cON_link.m +
    upper_arm.m +
    l_arm_link.m +
    nut.m +
    table.m +
    a_b___c_______1_0______d____e.m +
    balloon.m
    "Mass of the whole robot";

  replaceable Links.Chassis chassis(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"chassis\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-72, -36}, {-52, -16}})));

  replaceable Links.L_arm l_arm(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"l_arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-20, -36}, {0, -16}})));

  replaceable Links.End_link end_link(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"end\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{28, -36}, {48, -16}})));

  replaceable Links.Pinion pinion(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"pinion\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{28, -126}, {48, -106}})));

  replaceable Links.Name_link name_link(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"name\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-20, -216}, {0, -196}})));

  replaceable Links.Gelenk__ gelenk__(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"Gelenk_ä\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{28, -216}, {48, -196}})));

  replaceable Links.Time_link time_link(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"time\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{28, -306}, {48, -286}})));

  replaceable Links.CON_link cON_link(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"CON\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-20, -384}, {0, -364}})));

  replaceable Links.Upper_arm upper_arm(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"upper arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-20, -494}, {0, -474}})));

  replaceable Links.L_arm_link l_arm_link(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"L_arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{28, -494}, {48, -474}})));

  replaceable Links.Nut nut(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"nut\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{28, -584}, {48, -564}})));

  replaceable Links.Table table(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"table\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-20, -646}, {0, -626}})));

  replaceable Links.A_b___c_______1_0______d____e a_b___c_______1_0______d____e(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{28, -646}, {48, -626}})));

  replaceable Links.Balloon balloon(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"balloon\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-20, -708}, {0, -688}})));

  replaceable Joints.Lift lift(
    s_min = max({lift.parameters.limits.lower, end_jointMimic.leader_min}),
    s_max = min({lift.parameters.limits.upper, end_jointMimic.leader_max}),
    v_max = min({lift.parameters.limits.velocity, end_jointMimic.leaderSpeed_max}),
    fixedStart = fixedStart,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_min = max({lift.parameters.limits.lower, end_jointMimic.leader_min}),
      s_max = min({lift.parameters.limits.upper, end_jointMimic.leader_max}),
      v_max = min({lift.parameters.limits.velocity, end_jointMimic.leaderSpeed_max}),
      fixedStart = fixedStart,
      checkEffort = false,
      checkLimits = checkLimits)
    "Prismatic joint \"lift\" from link \"chassis\" to link \"l_arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -10}, {-36, 10}})));

  replaceable Joints.End_joint end_joint(
    s_min = max({end_joint.parameters.limits.lower, pinion_jointMimic.leader_min}),
    s_max = min({end_joint.parameters.limits.upper, pinion_jointMimic.leader_max}),
    v_max = min({end_joint.parameters.limits.velocity, pinion_jointMimic.leaderSpeed_max}),
    s_start = end_joint.parameters.mimic.multiplier*lift.s_start + end_joint.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_min = max({end_joint.parameters.limits.lower, pinion_jointMimic.leader_min}),
      s_max = min({end_joint.parameters.limits.upper, pinion_jointMimic.leader_max}),
      v_max = min({end_joint.parameters.limits.velocity, pinion_jointMimic.leaderSpeed_max}),
      s_start = end_joint.parameters.mimic.multiplier*lift.s_start + end_joint.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Prismatic joint \"end\" from link \"l_arm\" to link \"end\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-4, -10}, {16, 10}})));

  replaceable Joints.Pinion_joint pinion_joint(
    phi_start = pinion_joint.parameters.mimic.multiplier*end_joint.s_start + pinion_joint.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = pinion_joint.parameters.mimic.multiplier*end_joint.s_start + pinion_joint.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Continuous joint \"pinion\" from link \"l_arm\" to link \"pinion\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-4, -100}, {16, -80}})));

  replaceable Joints.Mount mount constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"mount\" from link \"chassis\" to link \"name\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -190}, {-36, -170}})));

  replaceable Joints.Held_slide held_slide(
    s_start = held_slide.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_start = held_slide.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Prismatic joint \"held slide\" from link \"name\" to link \"Gelenk_ä\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-4, -190}, {16, -170}})));

  replaceable Joints.Held_turn held_turn(
    phi_start = held_turn.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = held_turn.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Revolute joint \"held turn\" from link \"name\" to link \"time\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-4, -280}, {16, -260}})));

  replaceable Joints.Rotational rotational(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"rotational\" from link \"chassis\" to link \"CON\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -358}, {-36, -338}})));

  replaceable Joints.Shoulder shoulder(
    phi_min = max({shoulder.parameters.limits.lower, elbowMimic.leader_min, lead_screwMimic.leader_min}),
    phi_max = min({shoulder.parameters.limits.upper, elbowMimic.leader_max, lead_screwMimic.leader_max}),
    w_max = min({shoulder.parameters.limits.velocity, elbowMimic.leaderSpeed_max, lead_screwMimic.leaderSpeed_max}),
    fixedStart = fixedStart,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_min = max({shoulder.parameters.limits.lower, elbowMimic.leader_min, lead_screwMimic.leader_min}),
      phi_max = min({shoulder.parameters.limits.upper, elbowMimic.leader_max, lead_screwMimic.leader_max}),
      w_max = min({shoulder.parameters.limits.velocity, elbowMimic.leaderSpeed_max, lead_screwMimic.leaderSpeed_max}),
      fixedStart = fixedStart,
      checkEffort = false,
      checkLimits = checkLimits)
    "Revolute joint \"shoulder\" from link \"chassis\" to link \"upper arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -468}, {-36, -448}})));

  replaceable Joints.Elbow elbow(
    phi_start = elbow.parameters.mimic.multiplier*shoulder.phi_start + elbow.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = elbow.parameters.mimic.multiplier*shoulder.phi_start + elbow.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Revolute joint \"elbow\" from link \"upper arm\" to link \"L_arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-4, -468}, {16, -448}})));

  replaceable Joints.Lead_screw lead_screw(
    s_start = lead_screw.parameters.mimic.multiplier*shoulder.phi_start + lead_screw.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_start = lead_screw.parameters.mimic.multiplier*shoulder.phi_start + lead_screw.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Prismatic joint \"lead-screw\" from link \"upper arm\" to link \"nut\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-4, -558}, {16, -538}})));

  replaceable Joints.Table_joint table_joint constrainedby UrdfSync.Interfaces.PartialPlanarJoint
    "Planar joint \"table\" from link \"chassis\" to link \"table\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -620}, {-36, -600}})));

  replaceable Joints.Puck puck constrainedby UrdfSync.Interfaces.PartialPlanarJoint
    "Planar joint \"puck\" from link \"table\" to link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-4, -620}, {16, -600}})));

  replaceable Joints.Tether tether constrainedby UrdfSync.Interfaces.PartialFloatingJoint
    "Floating joint \"tether\" from link \"chassis\" to link \"balloon\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -682}, {-36, -662}})));

  UrdfSync.Couplings.TranslationalToTranslational end_jointMimic(
    s_min = end_joint.s_min,
    s_max = end_joint.s_max,
    v_max = end_joint.v_max,
    parameters = end_joint.parameters.mimic)
    "Joint \"end\" follows joint \"lift\""
    annotation (Placement(transformation(extent={{-20, 34}, {0, 54}})));

  UrdfSync.Couplings.TranslationalToRotational pinion_jointMimic(
    phi_min = pinion_joint.phi_min,
    phi_max = pinion_joint.phi_max,
    w_max = pinion_joint.w_max,
    parameters = pinion_joint.parameters.mimic)
    "Joint \"pinion\" follows joint \"end\""
    annotation (Placement(transformation(extent={{-20, -72}, {0, -52}})));

  UrdfSync.Couplings.HeldTranslational held_slideMimic(
    parameters = held_slide.parameters.mimic)
    "Joint \"held slide\" follows joint \"mount\""
    annotation (Placement(transformation(extent={{-20, -162}, {0, -142}})));

  UrdfSync.Couplings.HeldRotational held_turnMimic(
    parameters = held_turn.parameters.mimic)
    "Joint \"held turn\" follows joint \"mount\""
    annotation (Placement(transformation(extent={{-20, -252}, {0, -232}})));

  UrdfSync.Couplings.RotationalToRotational elbowMimic(
    phi_min = elbow.phi_min,
    phi_max = elbow.phi_max,
    w_max = elbow.w_max,
    parameters = elbow.parameters.mimic)
    "Joint \"elbow\" follows joint \"shoulder\""
    annotation (Placement(transformation(extent={{-20, -424}, {0, -404}})));

  UrdfSync.Couplings.RotationalToTranslational lead_screwMimic(
    s_min = lead_screw.s_min,
    s_max = lead_screw.s_max,
    v_max = lead_screw.v_max,
    parameters = lead_screw.parameters.mimic)
    "Joint \"lead-screw\" follows joint \"shoulder\""
    annotation (Placement(transformation(extent={{-20, -530}, {0, -510}})));

equation
  assert(not checkLimits or 0.999999*abs(liftAxis.f) <= lift.parameters.limits.effort + 1e-6,
    getInstanceName() + ".lift (joint " + lift.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  assert(not checkLimits or 0.999999*abs(shoulderAxis.tau) <= shoulder.parameters.limits.effort + 1e-6,
    getInstanceName() + ".shoulder (joint " + shoulder.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  connect(frame_a, chassis.frame_a)
    annotation (Line(points={{-100, 0}, {-76, 0}, {-76, -26}, {-72, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, lift.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, 0}, {-56, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(lift.frame_b, l_arm.frame_a)
    annotation (Line(points={{-36, 0}, {-24, 0}, {-24, -26}, {-20, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, mount.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -180}, {-56, -180}}, color={95, 95, 95}, thickness=0.5));
  connect(mount.frame_b, name_link.frame_a)
    annotation (Line(points={{-36, -180}, {-24, -180}, {-24, -206}, {-20, -206}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, rotational.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -348}, {-56, -348}}, color={95, 95, 95}, thickness=0.5));
  connect(rotational.frame_b, cON_link.frame_a)
    annotation (Line(points={{-36, -348}, {-24, -348}, {-24, -374}, {-20, -374}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, shoulder.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -458}, {-56, -458}}, color={95, 95, 95}, thickness=0.5));
  connect(shoulder.frame_b, upper_arm.frame_a)
    annotation (Line(points={{-36, -458}, {-24, -458}, {-24, -484}, {-20, -484}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, table_joint.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -610}, {-56, -610}}, color={95, 95, 95}, thickness=0.5));
  connect(table_joint.frame_b, table.frame_a)
    annotation (Line(points={{-36, -610}, {-24, -610}, {-24, -636}, {-20, -636}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, tether.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -672}, {-56, -672}}, color={95, 95, 95}, thickness=0.5));
  connect(tether.frame_b, balloon.frame_a)
    annotation (Line(points={{-36, -672}, {-24, -672}, {-24, -698}, {-20, -698}}, color={95, 95, 95}, thickness=0.5));
  connect(l_arm.frame_a, end_joint.frame_a)
    annotation (Line(points={{-20, -26}, {-24, -26}, {-24, 0}, {-4, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(end_joint.frame_b, end_link.frame_a)
    annotation (Line(points={{16, 0}, {24, 0}, {24, -26}, {28, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(l_arm.frame_a, pinion_joint.frame_a)
    annotation (Line(points={{-20, -26}, {-24, -26}, {-24, -90}, {-4, -90}}, color={95, 95, 95}, thickness=0.5));
  connect(pinion_joint.frame_b, pinion.frame_a)
    annotation (Line(points={{16, -90}, {24, -90}, {24, -116}, {28, -116}}, color={95, 95, 95}, thickness=0.5));
  connect(end_link.frame_a, end_linkFrame)
    annotation (Line(points={{28, -26}, {24, -26}, {24, 0}, {54, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(pinion.frame_a, pinionFrame)
    annotation (Line(points={{28, -116}, {24, -116}, {24, -90}, {54, -90}}, color={95, 95, 95}, thickness=0.5));
  connect(name_link.frame_a, held_slide.frame_a)
    annotation (Line(points={{-20, -206}, {-24, -206}, {-24, -180}, {-4, -180}}, color={95, 95, 95}, thickness=0.5));
  connect(held_slide.frame_b, gelenk__.frame_a)
    annotation (Line(points={{16, -180}, {24, -180}, {24, -206}, {28, -206}}, color={95, 95, 95}, thickness=0.5));
  connect(name_link.frame_a, held_turn.frame_a)
    annotation (Line(points={{-20, -206}, {-24, -206}, {-24, -270}, {-4, -270}}, color={95, 95, 95}, thickness=0.5));
  connect(held_turn.frame_b, time_link.frame_a)
    annotation (Line(points={{16, -270}, {24, -270}, {24, -296}, {28, -296}}, color={95, 95, 95}, thickness=0.5));
  connect(gelenk__.frame_a, gelenk__Frame)
    annotation (Line(points={{28, -206}, {24, -206}, {24, -180}, {54, -180}}, color={95, 95, 95}, thickness=0.5));
  connect(time_link.frame_a, time_linkFrame)
    annotation (Line(points={{28, -296}, {24, -296}, {24, -270}, {54, -270}}, color={95, 95, 95}, thickness=0.5));
  connect(cON_link.frame_a, cON_linkFrame)
    annotation (Line(points={{-20, -374}, {-24, -374}, {-24, -348}, {6, -348}}, color={95, 95, 95}, thickness=0.5));
  connect(upper_arm.frame_a, elbow.frame_a)
    annotation (Line(points={{-20, -484}, {-24, -484}, {-24, -458}, {-4, -458}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow.frame_b, l_arm_link.frame_a)
    annotation (Line(points={{16, -458}, {24, -458}, {24, -484}, {28, -484}}, color={95, 95, 95}, thickness=0.5));
  connect(upper_arm.frame_a, lead_screw.frame_a)
    annotation (Line(points={{-20, -484}, {-24, -484}, {-24, -548}, {-4, -548}}, color={95, 95, 95}, thickness=0.5));
  connect(lead_screw.frame_b, nut.frame_a)
    annotation (Line(points={{16, -548}, {24, -548}, {24, -574}, {28, -574}}, color={95, 95, 95}, thickness=0.5));
  connect(l_arm_link.frame_a, l_arm_linkFrame)
    annotation (Line(points={{28, -484}, {24, -484}, {24, -458}, {54, -458}}, color={95, 95, 95}, thickness=0.5));
  connect(nut.frame_a, nutFrame)
    annotation (Line(points={{28, -574}, {24, -574}, {24, -548}, {54, -548}}, color={95, 95, 95}, thickness=0.5));
  connect(table.frame_a, puck.frame_a)
    annotation (Line(points={{-20, -636}, {-24, -636}, {-24, -610}, {-4, -610}}, color={95, 95, 95}, thickness=0.5));
  connect(puck.frame_b, a_b___c_______1_0______d____e.frame_a)
    annotation (Line(points={{16, -610}, {24, -610}, {24, -636}, {28, -636}}, color={95, 95, 95}, thickness=0.5));
  connect(a_b___c_______1_0______d____e.frame_a, a_b___c_______1_0______d____eFrame)
    annotation (Line(points={{28, -636}, {24, -636}, {24, -610}, {54, -610}}, color={95, 95, 95}, thickness=0.5));
  connect(balloon.frame_a, balloonFrame)
    annotation (Line(points={{-20, -698}, {-24, -698}, {-24, -672}, {6, -672}}, color={95, 95, 95}, thickness=0.5));
  connect(lift.axis, liftAxis)
    annotation (Line(points={{-46, 10}, {-46, 20}}, color={0, 127, 0}));
  connect(lift.support, liftSupport)
    annotation (Line(points={{-52, 10}, {-52, 12}, {-60, 12}, {-60, 20}}, color={0, 127, 0}));
  connect(rotational.axis, rotationalAxis_2)
    annotation (Line(points={{-46, -338}, {-46, -328}}, color={0, 0, 0}));
  connect(rotational.support, rotationalSupport_2)
    annotation (Line(points={{-52, -338}, {-52, -336}, {-60, -336}, {-60, -328}}, color={0, 0, 0}));
  connect(shoulder.axis, shoulderAxis)
    annotation (Line(points={{-46, -448}, {-46, -438}}, color={0, 0, 0}));
  connect(shoulder.support, shoulderSupport)
    annotation (Line(points={{-52, -448}, {-52, -446}, {-60, -446}, {-60, -438}}, color={0, 0, 0}));
  connect(end_jointMimic.follower, end_joint.axis)
    annotation (Line(points={{0, 44}, {6, 44}, {6, 10}}, color={0, 127, 0}));
  connect(end_jointMimic.leader, lift.axis)
    annotation (Line(points={{-20, 44}, {-28, 44}, {-28, 66}, {-38, 66}, {-38, 12}, {-46, 12}, {-46, 10}}, color={0, 127, 0}));
  connect(pinion_jointMimic.follower, pinion_joint.axis)
    annotation (Line(points={{0, -62}, {6, -62}, {6, -80}}, color={0, 0, 0}));
  connect(pinion_jointMimic.leader, end_joint.axis)
    annotation (Line(points={{-20, -62}, {-32, -62}, {-32, 62}, {6, 62}, {6, 10}}, color={0, 127, 0}));
  connect(held_slideMimic.follower, held_slide.axis)
    annotation (Line(points={{0, -152}, {6, -152}, {6, -170}}, color={0, 127, 0}));
  connect(held_turnMimic.follower, held_turn.axis)
    annotation (Line(points={{0, -242}, {6, -242}, {6, -260}}, color={0, 0, 0}));
  connect(elbowMimic.follower, elbow.axis)
    annotation (Line(points={{0, -414}, {6, -414}, {6, -448}}, color={0, 0, 0}));
  connect(elbowMimic.leader, shoulder.axis)
    annotation (Line(points={{-20, -414}, {-28, -414}, {-28, -396}, {-38, -396}, {-38, -446}, {-46, -446}, {-46, -448}}, color={0, 0, 0}));
  connect(lead_screwMimic.follower, lead_screw.axis)
    annotation (Line(points={{0, -520}, {6, -520}, {6, -538}}, color={0, 127, 0}));
  connect(lead_screwMimic.leader, shoulder.axis)
    annotation (Line(points={{-20, -520}, {-28, -520}, {-28, -396}, {-38, -396}, {-38, -446}, {-46, -446}, {-46, -448}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 290}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 290}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 146}, {0, 164}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="lift"),
      Text(extent={{-90, 126}, {0, 144}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="rotational"),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="shoulder"),
      Text(extent={{0, 273}, {88, 287}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="end_link"),
      Text(extent={{0, 253}, {88, 267}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="pinion"),
      Text(extent={{0, 233}, {88, 247}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="gelenk__"),
      Text(extent={{0, 213}, {88, 227}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="time_link"),
      Text(extent={{0, 193}, {88, 207}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="cON_link"),
      Text(extent={{0, 173}, {88, 187}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="l_arm_link"),
      Text(extent={{0, 153}, {88, 167}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="nut"),
      Text(extent={{0, 133}, {88, 147}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="a_b___c_______1_0______d____e"),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="balloon")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -716}, {88, 70}})),
    Documentation(info="<html>
<p>
Links and joints of robot Menagerie, connected. Each can be exchanged in a model that extends this one. A drive of joint <code>elbow</code>, say, is connected to <code>elbowAxis</code> and <code>elbowSupport</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end Menagerie;
