within Zoo.Menagerie;

model Menagerie "Robot Menagerie"
  extends UrdfSync.Robots.PartialStationaryRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b end_linkFrame
    "Frame of link \"end\""
    annotation (Placement(transformation(extent={{44, -10}, {64, 10}}), iconTransformation(extent={{92, 312}, {108, 328}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b pinionFrame
    "Frame of link \"pinion\""
    annotation (Placement(transformation(extent={{44, -156}, {64, -136}}), iconTransformation(extent={{92, 292}, {108, 308}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b gelenk__Frame
    "Frame of link \"Gelenk_ä\""
    annotation (Placement(transformation(extent={{44, -246}, {64, -226}}), iconTransformation(extent={{92, 272}, {108, 288}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b time_linkFrame
    "Frame of link \"time\""
    annotation (Placement(transformation(extent={{44, -336}, {64, -316}}), iconTransformation(extent={{92, 252}, {108, 268}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b cON_linkFrame
    "Frame of link \"CON\""
    annotation (Placement(transformation(extent={{-4, -414}, {16, -394}}), iconTransformation(extent={{92, 232}, {108, 248}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b l_arm_linkFrame
    "Frame of link \"L_arm\""
    annotation (Placement(transformation(extent={{44, -524}, {64, -504}}), iconTransformation(extent={{92, 212}, {108, 228}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b nutFrame
    "Frame of link \"nut\""
    annotation (Placement(transformation(extent={{44, -614}, {64, -594}}), iconTransformation(extent={{92, 192}, {108, 208}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b a_b___c_______1_0______d____eFrame
    "Frame of link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
    annotation (Placement(transformation(extent={{44, -676}, {64, -656}}), iconTransformation(extent={{92, 172}, {108, 188}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b balloonFrame
    "Frame of link \"balloon\""
    annotation (Placement(transformation(extent={{-4, -766}, {16, -746}}), iconTransformation(extent={{92, 152}, {108, 168}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b a_b___c_Frame
    "Frame of sensor \"a\"b\\ <c>\""
    annotation (Placement(transformation(extent={{4, -726}, {16, -714}}), iconTransformation(extent={{92, 132}, {108, 148}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b table_sensorFrame
    "Frame of sensor \"table\""
    annotation (Placement(transformation(extent={{-48, -88}, {-36, -76}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a liftAxis
    "Axis of joint \"lift\""
    annotation (Placement(transformation(extent={{-52, 14}, {-40, 26}}), iconTransformation(extent={{-104, 156}, {-96, 164}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b liftSupport
    "Housing of the drive of joint \"lift\""
    annotation (Placement(transformation(extent={{-66, 14}, {-54, 26}}), iconTransformation(extent={{-104, 146}, {-96, 154}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a rotationalAxis_2
    "Axis of joint \"rotational\""
    annotation (Placement(transformation(extent={{-52, -390}, {-40, -378}}), iconTransformation(extent={{-104, 136}, {-96, 144}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rotationalSupport_2
    "Housing of the drive of joint \"rotational\""
    annotation (Placement(transformation(extent={{-66, -390}, {-54, -378}}), iconTransformation(extent={{-104, 126}, {-96, 134}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a shoulderAxis
    "Axis of joint \"shoulder\""
    annotation (Placement(transformation(extent={{-52, -500}, {-40, -488}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b shoulderSupport
    "Housing of the drive of joint \"shoulder\""
    annotation (Placement(transformation(extent={{-66, -500}, {-54, -488}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

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

  parameter MenagerieSensors sensorParameters
    "Numbers of the sensors"
    annotation (Placement(transformation(extent={{-110, -828}, {-90, -808}})));

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
    annotation (choicesAllMatching=true, Placement(transformation(extent={{28, -182}, {48, -162}})));

  replaceable Links.Name_link name_link(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"name\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-20, -272}, {0, -252}})));

  replaceable Links.Gelenk__ gelenk__(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"Gelenk_ä\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{28, -272}, {48, -252}})));

  replaceable Links.Time_link time_link(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"time\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{28, -362}, {48, -342}})));

  replaceable Links.CON_link cON_link(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"CON\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-20, -440}, {0, -420}})));

  replaceable Links.Upper_arm upper_arm(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"upper arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-20, -550}, {0, -530}})));

  replaceable Links.L_arm_link l_arm_link(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"L_arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{28, -550}, {48, -530}})));

  replaceable Links.Nut nut(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"nut\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{28, -640}, {48, -620}})));

  replaceable Links.Table table(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"table\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-20, -702}, {0, -682}})));

  replaceable Links.A_b___c_______1_0______d____e a_b___c_______1_0______d____e(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{28, -702}, {48, -682}})));

  replaceable Links.Balloon balloon(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"balloon\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-20, -792}, {0, -772}})));

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
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-4, -156}, {16, -136}})));

  replaceable Joints.Mount mount constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"mount\" from link \"chassis\" to link \"name\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -246}, {-36, -226}})));

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
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-4, -246}, {16, -226}})));

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
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-4, -336}, {16, -316}})));

  replaceable Joints.Rotational rotational(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"rotational\" from link \"chassis\" to link \"CON\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -414}, {-36, -394}})));

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
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -524}, {-36, -504}})));

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
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-4, -524}, {16, -504}})));

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
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-4, -614}, {16, -594}})));

  replaceable Joints.Table_joint table_joint constrainedby UrdfSync.Interfaces.PartialPlanarJoint
    "Planar joint \"table\" from link \"chassis\" to link \"table\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -676}, {-36, -656}})));

  replaceable Joints.Puck puck constrainedby UrdfSync.Interfaces.PartialPlanarJoint
    "Planar joint \"puck\" from link \"table\" to link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-4, -676}, {16, -656}})));

  replaceable Joints.Tether tether constrainedby UrdfSync.Interfaces.PartialFloatingJoint
    "Floating joint \"tether\" from link \"chassis\" to link \"balloon\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -766}, {-36, -746}})));

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
    annotation (Placement(transformation(extent={{-20, -128}, {0, -108}})));

  UrdfSync.Couplings.HeldTranslational held_slideMimic(
    parameters = held_slide.parameters.mimic)
    "Joint \"held slide\" follows joint \"mount\""
    annotation (Placement(transformation(extent={{-20, -218}, {0, -198}})));

  UrdfSync.Couplings.HeldRotational held_turnMimic(
    parameters = held_turn.parameters.mimic)
    "Joint \"held turn\" follows joint \"mount\""
    annotation (Placement(transformation(extent={{-20, -308}, {0, -288}})));

  UrdfSync.Couplings.RotationalToRotational elbowMimic(
    phi_min = elbow.phi_min,
    phi_max = elbow.phi_max,
    w_max = elbow.w_max,
    parameters = elbow.parameters.mimic)
    "Joint \"elbow\" follows joint \"shoulder\""
    annotation (Placement(transformation(extent={{-20, -480}, {0, -460}})));

  UrdfSync.Couplings.RotationalToTranslational lead_screwMimic(
    s_min = lead_screw.s_min,
    s_max = lead_screw.s_max,
    v_max = lead_screw.v_max,
    parameters = lead_screw.parameters.mimic)
    "Joint \"lead-screw\" follows joint \"shoulder\""
    annotation (Placement(transformation(extent={{-20, -586}, {0, -566}})));

  UrdfSync.Sensors.Lidar a_b___c_(parameters = sensorParameters.a_b___c_)
    "Sensor \"a\"b\\ <c>\" of link \"table\""
    annotation (Placement(transformation(extent={{-20, -730}, {0, -710}})));

  UrdfSync.Sensors.Imu imu(parameters = sensorParameters.imu)
    "Sensor \"imu\" of link \"chassis\""
    annotation (Placement(transformation(extent={{-72, -64}, {-52, -44}})));

  UrdfSync.Sensors.ForceTorque lift_sensor(
    parameters = sensorParameters.lift_sensor,
    f_joint = -lift.frame_a.R.T*(lift.frame_b.f*lift.frame_b.R.T),
    t_joint = -lift.frame_a.R.T*(lift.frame_b.t*lift.frame_b.R.T))
    "Sensor \"lift\" of joint \"lift\""
    annotation (Placement(transformation(extent={{-20, -64}, {0, -44}})));

  UrdfSync.Sensors.Camera table_sensor(parameters = sensorParameters.table_sensor)
    "Sensor \"table\" of link \"chassis\""
    annotation (Placement(transformation(extent={{-72, -92}, {-52, -72}})));

equation
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(liftAxis.f), lift.parameters.limits.effort)),
    getInstanceName() + ".lift (joint " + lift.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(shoulderAxis.tau), shoulder.parameters.limits.effort)),
    getInstanceName() + ".shoulder (joint " + shoulder.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  connect(frame_a, chassis.frame_a)
    annotation (Line(points={{-100, 0}, {-76, 0}, {-76, -26}, {-72, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, imu.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -54}, {-72, -54}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, table_sensor.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -82}, {-72, -82}}, color={95, 95, 95}, thickness=0.5));
  connect(table_sensor.frame_b, table_sensorFrame)
    annotation (Line(points={{-52, -82}, {-42, -82}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, lift.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, 0}, {-56, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(lift.frame_b, l_arm.frame_a)
    annotation (Line(points={{-36, 0}, {-24, 0}, {-24, -26}, {-20, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, mount.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -236}, {-56, -236}}, color={95, 95, 95}, thickness=0.5));
  connect(mount.frame_b, name_link.frame_a)
    annotation (Line(points={{-36, -236}, {-24, -236}, {-24, -262}, {-20, -262}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, rotational.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -404}, {-56, -404}}, color={95, 95, 95}, thickness=0.5));
  connect(rotational.frame_b, cON_link.frame_a)
    annotation (Line(points={{-36, -404}, {-24, -404}, {-24, -430}, {-20, -430}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, shoulder.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -514}, {-56, -514}}, color={95, 95, 95}, thickness=0.5));
  connect(shoulder.frame_b, upper_arm.frame_a)
    annotation (Line(points={{-36, -514}, {-24, -514}, {-24, -540}, {-20, -540}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, table_joint.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -666}, {-56, -666}}, color={95, 95, 95}, thickness=0.5));
  connect(table_joint.frame_b, table.frame_a)
    annotation (Line(points={{-36, -666}, {-24, -666}, {-24, -692}, {-20, -692}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, tether.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -756}, {-56, -756}}, color={95, 95, 95}, thickness=0.5));
  connect(tether.frame_b, balloon.frame_a)
    annotation (Line(points={{-36, -756}, {-24, -756}, {-24, -782}, {-20, -782}}, color={95, 95, 95}, thickness=0.5));
  connect(l_arm.frame_a, end_joint.frame_a)
    annotation (Line(points={{-20, -26}, {-24, -26}, {-24, 0}, {-4, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(end_joint.frame_b, end_link.frame_a)
    annotation (Line(points={{16, 0}, {24, 0}, {24, -26}, {28, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(l_arm.frame_a, pinion_joint.frame_a)
    annotation (Line(points={{-20, -26}, {-24, -26}, {-24, -146}, {-4, -146}}, color={95, 95, 95}, thickness=0.5));
  connect(pinion_joint.frame_b, pinion.frame_a)
    annotation (Line(points={{16, -146}, {24, -146}, {24, -172}, {28, -172}}, color={95, 95, 95}, thickness=0.5));
  connect(end_link.frame_a, end_linkFrame)
    annotation (Line(points={{28, -26}, {24, -26}, {24, 0}, {54, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(pinion.frame_a, pinionFrame)
    annotation (Line(points={{28, -172}, {24, -172}, {24, -146}, {54, -146}}, color={95, 95, 95}, thickness=0.5));
  connect(name_link.frame_a, held_slide.frame_a)
    annotation (Line(points={{-20, -262}, {-24, -262}, {-24, -236}, {-4, -236}}, color={95, 95, 95}, thickness=0.5));
  connect(held_slide.frame_b, gelenk__.frame_a)
    annotation (Line(points={{16, -236}, {24, -236}, {24, -262}, {28, -262}}, color={95, 95, 95}, thickness=0.5));
  connect(name_link.frame_a, held_turn.frame_a)
    annotation (Line(points={{-20, -262}, {-24, -262}, {-24, -326}, {-4, -326}}, color={95, 95, 95}, thickness=0.5));
  connect(held_turn.frame_b, time_link.frame_a)
    annotation (Line(points={{16, -326}, {24, -326}, {24, -352}, {28, -352}}, color={95, 95, 95}, thickness=0.5));
  connect(gelenk__.frame_a, gelenk__Frame)
    annotation (Line(points={{28, -262}, {24, -262}, {24, -236}, {54, -236}}, color={95, 95, 95}, thickness=0.5));
  connect(time_link.frame_a, time_linkFrame)
    annotation (Line(points={{28, -352}, {24, -352}, {24, -326}, {54, -326}}, color={95, 95, 95}, thickness=0.5));
  connect(cON_link.frame_a, cON_linkFrame)
    annotation (Line(points={{-20, -430}, {-24, -430}, {-24, -404}, {6, -404}}, color={95, 95, 95}, thickness=0.5));
  connect(upper_arm.frame_a, elbow.frame_a)
    annotation (Line(points={{-20, -540}, {-24, -540}, {-24, -514}, {-4, -514}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow.frame_b, l_arm_link.frame_a)
    annotation (Line(points={{16, -514}, {24, -514}, {24, -540}, {28, -540}}, color={95, 95, 95}, thickness=0.5));
  connect(upper_arm.frame_a, lead_screw.frame_a)
    annotation (Line(points={{-20, -540}, {-24, -540}, {-24, -604}, {-4, -604}}, color={95, 95, 95}, thickness=0.5));
  connect(lead_screw.frame_b, nut.frame_a)
    annotation (Line(points={{16, -604}, {24, -604}, {24, -630}, {28, -630}}, color={95, 95, 95}, thickness=0.5));
  connect(l_arm_link.frame_a, l_arm_linkFrame)
    annotation (Line(points={{28, -540}, {24, -540}, {24, -514}, {54, -514}}, color={95, 95, 95}, thickness=0.5));
  connect(nut.frame_a, nutFrame)
    annotation (Line(points={{28, -630}, {24, -630}, {24, -604}, {54, -604}}, color={95, 95, 95}, thickness=0.5));
  connect(table.frame_a, a_b___c_.frame_a)
    annotation (Line(points={{-20, -692}, {-24, -692}, {-24, -720}, {-20, -720}}, color={95, 95, 95}, thickness=0.5));
  connect(a_b___c_.frame_b, a_b___c_Frame)
    annotation (Line(points={{0, -720}, {10, -720}}, color={95, 95, 95}, thickness=0.5));
  connect(table.frame_a, puck.frame_a)
    annotation (Line(points={{-20, -692}, {-24, -692}, {-24, -666}, {-4, -666}}, color={95, 95, 95}, thickness=0.5));
  connect(puck.frame_b, a_b___c_______1_0______d____e.frame_a)
    annotation (Line(points={{16, -666}, {24, -666}, {24, -692}, {28, -692}}, color={95, 95, 95}, thickness=0.5));
  connect(a_b___c_______1_0______d____e.frame_a, a_b___c_______1_0______d____eFrame)
    annotation (Line(points={{28, -692}, {24, -692}, {24, -666}, {54, -666}}, color={95, 95, 95}, thickness=0.5));
  connect(balloon.frame_a, balloonFrame)
    annotation (Line(points={{-20, -782}, {-24, -782}, {-24, -756}, {6, -756}}, color={95, 95, 95}, thickness=0.5));
  connect(lift.axis, liftAxis)
    annotation (Line(points={{-46, 10}, {-46, 20}}, color={0, 127, 0}));
  connect(lift.support, liftSupport)
    annotation (Line(points={{-52, 10}, {-52, 12}, {-60, 12}, {-60, 20}}, color={0, 127, 0}));
  connect(rotational.axis, rotationalAxis_2)
    annotation (Line(points={{-46, -394}, {-46, -384}}, color={0, 0, 0}));
  connect(rotational.support, rotationalSupport_2)
    annotation (Line(points={{-52, -394}, {-52, -392}, {-60, -392}, {-60, -384}}, color={0, 0, 0}));
  connect(shoulder.axis, shoulderAxis)
    annotation (Line(points={{-46, -504}, {-46, -494}}, color={0, 0, 0}));
  connect(shoulder.support, shoulderSupport)
    annotation (Line(points={{-52, -504}, {-52, -502}, {-60, -502}, {-60, -494}}, color={0, 0, 0}));
  connect(end_jointMimic.follower, end_joint.axis)
    annotation (Line(points={{0, 44}, {6, 44}, {6, 10}}, color={0, 127, 0}));
  connect(end_jointMimic.leader, lift.axis)
    annotation (Line(points={{-20, 44}, {-28, 44}, {-28, 66}, {-38, 66}, {-38, 12}, {-46, 12}, {-46, 10}}, color={0, 127, 0}));
  connect(pinion_jointMimic.follower, pinion_joint.axis)
    annotation (Line(points={{0, -118}, {6, -118}, {6, -136}}, color={0, 0, 0}));
  connect(pinion_jointMimic.leader, end_joint.axis)
    annotation (Line(points={{-20, -118}, {-32, -118}, {-32, 62}, {6, 62}, {6, 10}}, color={0, 127, 0}));
  connect(held_slideMimic.follower, held_slide.axis)
    annotation (Line(points={{0, -208}, {6, -208}, {6, -226}}, color={0, 127, 0}));
  connect(held_turnMimic.follower, held_turn.axis)
    annotation (Line(points={{0, -298}, {6, -298}, {6, -316}}, color={0, 0, 0}));
  connect(elbowMimic.follower, elbow.axis)
    annotation (Line(points={{0, -470}, {6, -470}, {6, -504}}, color={0, 0, 0}));
  connect(elbowMimic.leader, shoulder.axis)
    annotation (Line(points={{-20, -470}, {-28, -470}, {-28, -452}, {-38, -452}, {-38, -502}, {-46, -502}, {-46, -504}}, color={0, 0, 0}));
  connect(lead_screwMimic.follower, lead_screw.axis)
    annotation (Line(points={{0, -576}, {6, -576}, {6, -594}}, color={0, 127, 0}));
  connect(lead_screwMimic.leader, shoulder.axis)
    annotation (Line(points={{-20, -576}, {-28, -576}, {-28, -452}, {-38, -452}, {-38, -502}, {-46, -502}, {-46, -504}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 330}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 330}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 146}, {0, 164}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="lift"),
      Text(extent={{-90, 126}, {0, 144}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="rotational"),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="shoulder"),
      Text(extent={{0, 313}, {88, 327}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="end_link"),
      Text(extent={{0, 293}, {88, 307}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="pinion"),
      Text(extent={{0, 273}, {88, 287}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="gelenk__"),
      Text(extent={{0, 253}, {88, 267}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="time_link"),
      Text(extent={{0, 233}, {88, 247}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="cON_link"),
      Text(extent={{0, 213}, {88, 227}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="l_arm_link"),
      Text(extent={{0, 193}, {88, 207}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="nut"),
      Text(extent={{0, 173}, {88, 187}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="a_b___c_______1_0______d____e"),
      Text(extent={{0, 153}, {88, 167}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="balloon"),
      Text(extent={{0, 133}, {88, 147}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="a\"b\\ <c>"),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="table")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -828}, {88, 70}})),
    Documentation(info="<html>
<p>
Links and joints of robot Menagerie, connected. Each can be exchanged in a model that extends this one. A drive of joint <code>elbow</code>, say, is connected to <code>elbowAxis</code> and <code>elbowSupport</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end Menagerie;
