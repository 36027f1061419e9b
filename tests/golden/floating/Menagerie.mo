within Zoo.Menagerie;

model Menagerie "Robot Menagerie"
  extends UrdfSync.Robots.PartialMobileRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b end_847803Frame
    "Frame of link \"end\""
    annotation (Placement(transformation(extent={{92, -10}, {112, 10}}), iconTransformation(extent={{92, 252}, {108, 268}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b pinion_link_c664fcFrame
    "Frame of link \"pinion\""
    annotation (Placement(transformation(extent={{92, -808}, {112, -788}}), iconTransformation(extent={{92, 292}, {108, 308}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b gelenk_a_7bf08cFrame
    "Frame of link \"Gelenk_ä\""
    annotation (Placement(transformation(extent={{92, -352}, {112, -332}}), iconTransformation(extent={{92, 332}, {108, 348}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b time_2071dfFrame
    "Frame of link \"time\""
    annotation (Placement(transformation(extent={{92, -694}, {112, -674}}), iconTransformation(extent={{92, 172}, {108, 188}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b cON_436c9eFrame
    "Frame of link \"CON\""
    annotation (Placement(transformation(extent={{32, -1264}, {52, -1244}}), iconTransformation(extent={{92, 192}, {108, 208}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b l_arm_link_ff9950Frame
    "Frame of link \"L_arm\""
    annotation (Placement(transformation(extent={{92, -124}, {112, -104}}), iconTransformation(extent={{92, 352}, {108, 368}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b nutFrame
    "Frame of link \"nut\""
    annotation (Placement(transformation(extent={{92, -580}, {112, -560}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b a_b_c_1_0_d_e_1c5357Frame
    "Frame of link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
    annotation (Placement(transformation(extent={{92, -466}, {112, -446}}), iconTransformation(extent={{92, 272}, {108, 288}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b balloonFrame
    "Frame of link \"balloon\""
    annotation (Placement(transformation(extent={{32, -238}, {52, -218}}), iconTransformation(extent={{92, 312}, {108, 328}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b a_b_c_61f936Frame
    "Frame of sensor \"a\"b\\ <c>\""
    annotation (Placement(transformation(extent={{40, -1032}, {52, -1020}}), iconTransformation(extent={{92, 152}, {108, 168}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b doorFrame
    "Frame of sensor \"door\""
    annotation (Placement(transformation(extent={{40, -918}, {52, -906}}), iconTransformation(extent={{92, 232}, {108, 248}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b tableFrame
    "Frame of sensor \"table\""
    annotation (Placement(transformation(extent={{-36, -576}, {-24, -564}}), iconTransformation(extent={{92, 132}, {108, 148}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a liftAxis
    "Axis of joint \"lift\""
    annotation (Placement(transformation(extent={{-40, 14}, {-28, 26}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b liftSupport
    "Housing of the drive of joint \"lift\""
    annotation (Placement(transformation(extent={{-54, 14}, {-42, 26}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a rotationalAxis_2
    "Axis of joint \"rotational\""
    annotation (Placement(transformation(extent={{-40, -1240}, {-28, -1228}}), iconTransformation(extent={{-104, 176}, {-96, 184}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rotationalSupport_2
    "Housing of the drive of joint \"rotational\""
    annotation (Placement(transformation(extent={{-54, -1240}, {-42, -1228}}), iconTransformation(extent={{-104, 166}, {-96, 174}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a shoulderAxis
    "Axis of joint \"shoulder\""
    annotation (Placement(transformation(extent={{-40, -100}, {-28, -88}}), iconTransformation(extent={{-104, 136}, {-96, 144}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b shoulderSupport
    "Housing of the drive of joint \"shoulder\""
    annotation (Placement(transformation(extent={{-54, -100}, {-42, -88}}), iconTransformation(extent={{-104, 126}, {-96, 134}})));

  final parameter Modelica.Units.SI.Mass m =
    chassis.m +
    l_arm_link_6c89e3.m +
    end_847803.m +
    pinion_link_c664fc.m +
    name_641e44.m +
    gelenk_a_7bf08c.m +
    time_2071df.m +
    cON_436c9e.m +
    upper_arm_99dc4e.m +
    l_arm_link_ff9950.m +
    nut.m +
    table_link_04a94c.m +
    a_b_c_1_0_d_e_1c5357.m +
    balloon.m
    "Mass of the whole robot";

  parameter MenagerieSensors sensorParameters
    "Numbers of the sensors"
    annotation (Placement(transformation(extent={{-110, -1440}, {-90, -1420}})));

  replaceable Links.Chassis chassis(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"chassis\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-60, -36}, {-40, -16}})));

  replaceable Links.L_arm_link_6c89e3 l_arm_link_6c89e3(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"l_arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -36}, {36, -16}})));

  replaceable Links.End_847803 end_847803(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"end\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{76, -36}, {96, -16}})));

  replaceable Links.Pinion_link_c664fc pinion_link_c664fc(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"pinion\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{76, -834}, {96, -814}})));

  replaceable Links.Name_641e44 name_641e44(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"name\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -378}, {36, -358}})));

  replaceable Links.Gelenk_a_7bf08c gelenk_a_7bf08c(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"Gelenk_ä\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{76, -378}, {96, -358}})));

  replaceable Links.Time_2071df time_2071df(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"time\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{76, -720}, {96, -700}})));

  replaceable Links.CON_436c9e cON_436c9e(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"CON\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -1290}, {36, -1270}})));

  replaceable Links.Upper_arm_99dc4e upper_arm_99dc4e(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"upper arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -150}, {36, -130}})));

  replaceable Links.L_arm_link_ff9950 l_arm_link_ff9950(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"L_arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{76, -150}, {96, -130}})));

  replaceable Links.Nut nut(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"nut\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{76, -606}, {96, -586}})));

  replaceable Links.Table_link_04a94c table_link_04a94c(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"table\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -492}, {36, -472}})));

  replaceable Links.A_b_c_1_0_d_e_1c5357 a_b_c_1_0_d_e_1c5357(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{76, -492}, {96, -472}})));

  replaceable Links.Balloon balloon(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"balloon\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -264}, {36, -244}})));

  replaceable Joints.Lift lift(
    s_min = max({lift.parameters.limits.lower, end_e90631Mimic.leader_min}),
    s_max = min({lift.parameters.limits.upper, end_e90631Mimic.leader_max}),
    v_max = min({lift.parameters.limits.velocity, end_e90631Mimic.leaderSpeed_max}),
    fixedStart = fixedStart,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_min = max({lift.parameters.limits.lower, end_e90631Mimic.leader_min}),
      s_max = min({lift.parameters.limits.upper, end_e90631Mimic.leader_max}),
      v_max = min({lift.parameters.limits.velocity, end_e90631Mimic.leaderSpeed_max}),
      fixedStart = fixedStart,
      checkEffort = false,
      checkLimits = checkLimits)
    "Prismatic joint \"lift\" from link \"chassis\" to link \"l_arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -10}, {-24, 10}})));

  replaceable Joints.End_e90631 end_e90631(
    s_min = max({end_e90631.parameters.limits.lower, pinion_joint_d4c7e8Mimic.leader_min}),
    s_max = min({end_e90631.parameters.limits.upper, pinion_joint_d4c7e8Mimic.leader_max}),
    v_max = min({end_e90631.parameters.limits.velocity, pinion_joint_d4c7e8Mimic.leaderSpeed_max}),
    s_start = end_e90631.parameters.mimic.multiplier*lift.s_start + end_e90631.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_min = max({end_e90631.parameters.limits.lower, pinion_joint_d4c7e8Mimic.leader_min}),
      s_max = min({end_e90631.parameters.limits.upper, pinion_joint_d4c7e8Mimic.leader_max}),
      v_max = min({end_e90631.parameters.limits.velocity, pinion_joint_d4c7e8Mimic.leaderSpeed_max}),
      s_start = end_e90631.parameters.mimic.multiplier*lift.s_start + end_e90631.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Prismatic joint \"end\" from link \"l_arm\" to link \"end\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{32, -10}, {52, 10}})));

  replaceable Joints.Pinion_joint_d4c7e8 pinion_joint_d4c7e8(
    phi_start = pinion_joint_d4c7e8.parameters.mimic.multiplier*end_e90631.s_start + pinion_joint_d4c7e8.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = pinion_joint_d4c7e8.parameters.mimic.multiplier*end_e90631.s_start + pinion_joint_d4c7e8.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Continuous joint \"pinion\" from link \"l_arm\" to link \"pinion\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{32, -808}, {52, -788}})));

  replaceable Joints.Mount mount constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"mount\" from link \"chassis\" to link \"name\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -352}, {-24, -332}})));

  replaceable Joints.Held_slide_856a5a held_slide_856a5a(
    s_start = held_slide_856a5a.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_start = held_slide_856a5a.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Prismatic joint \"held slide\" from link \"name\" to link \"Gelenk_ä\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{32, -352}, {52, -332}})));

  replaceable Joints.Held_turn_a231f5 held_turn_a231f5(
    phi_start = held_turn_a231f5.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = held_turn_a231f5.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Revolute joint \"held turn\" from link \"name\" to link \"time\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{32, -694}, {52, -674}})));

  replaceable Joints.Rotational rotational(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"rotational\" from link \"chassis\" to link \"CON\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -1264}, {-24, -1244}})));

  replaceable Joints.Shoulder shoulder(
    phi_min = max({shoulder.parameters.limits.lower, elbowMimic.leader_min, lead__screwMimic.leader_min}),
    phi_max = min({shoulder.parameters.limits.upper, elbowMimic.leader_max, lead__screwMimic.leader_max}),
    w_max = min({shoulder.parameters.limits.velocity, elbowMimic.leaderSpeed_max, lead__screwMimic.leaderSpeed_max}),
    fixedStart = fixedStart,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_min = max({shoulder.parameters.limits.lower, elbowMimic.leader_min, lead__screwMimic.leader_min}),
      phi_max = min({shoulder.parameters.limits.upper, elbowMimic.leader_max, lead__screwMimic.leader_max}),
      w_max = min({shoulder.parameters.limits.velocity, elbowMimic.leaderSpeed_max, lead__screwMimic.leaderSpeed_max}),
      fixedStart = fixedStart,
      checkEffort = false,
      checkLimits = checkLimits)
    "Revolute joint \"shoulder\" from link \"chassis\" to link \"upper arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -124}, {-24, -104}})));

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
    annotation (choicesAllMatching=true, Placement(transformation(extent={{32, -124}, {52, -104}})));

  replaceable Joints.Lead__screw lead__screw(
    s_start = lead__screw.parameters.mimic.multiplier*shoulder.phi_start + lead__screw.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_start = lead__screw.parameters.mimic.multiplier*shoulder.phi_start + lead__screw.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Prismatic joint \"lead-screw\" from link \"upper arm\" to link \"nut\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{32, -580}, {52, -560}})));

  replaceable Joints.Table_joint_06ab04 table_joint_06ab04 constrainedby UrdfSync.Interfaces.PartialPlanarJoint
    "Planar joint \"table\" from link \"chassis\" to link \"table\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -466}, {-24, -446}})));

  replaceable Joints.Puck puck constrainedby UrdfSync.Interfaces.PartialPlanarJoint
    "Planar joint \"puck\" from link \"table\" to link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{32, -466}, {52, -446}})));

  replaceable Joints.Tether tether constrainedby UrdfSync.Interfaces.PartialFloatingJoint
    "Floating joint \"tether\" from link \"chassis\" to link \"balloon\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -238}, {-24, -218}})));

  UrdfSync.Couplings.TranslationalToTranslational end_e90631Mimic(
    s_min = end_e90631.s_min,
    s_max = end_e90631.s_max,
    v_max = end_e90631.v_max,
    parameters = end_e90631.parameters.mimic)
    "Joint \"end\" follows joint \"lift\""
    annotation (Placement(transformation(extent={{16, 34}, {36, 54}})));

  UrdfSync.Couplings.TranslationalToRotational pinion_joint_d4c7e8Mimic(
    phi_min = pinion_joint_d4c7e8.phi_min,
    phi_max = pinion_joint_d4c7e8.phi_max,
    w_max = pinion_joint_d4c7e8.w_max,
    parameters = pinion_joint_d4c7e8.parameters.mimic)
    "Joint \"pinion\" follows joint \"end\""
    annotation (Placement(transformation(extent={{16, -764}, {36, -744}})));

  UrdfSync.Couplings.HeldTranslational held_slide_856a5aMimic(
    parameters = held_slide_856a5a.parameters.mimic)
    "Joint \"held slide\" follows joint \"mount\""
    annotation (Placement(transformation(extent={{16, -308}, {36, -288}})));

  UrdfSync.Couplings.HeldRotational held_turn_a231f5Mimic(
    parameters = held_turn_a231f5.parameters.mimic)
    "Joint \"held turn\" follows joint \"mount\""
    annotation (Placement(transformation(extent={{16, -650}, {36, -630}})));

  UrdfSync.Couplings.RotationalToRotational elbowMimic(
    phi_min = elbow.phi_min,
    phi_max = elbow.phi_max,
    w_max = elbow.w_max,
    parameters = elbow.parameters.mimic)
    "Joint \"elbow\" follows joint \"shoulder\""
    annotation (Placement(transformation(extent={{16, -80}, {36, -60}})));

  UrdfSync.Couplings.RotationalToTranslational lead__screwMimic(
    s_min = lead__screw.s_min,
    s_max = lead__screw.s_max,
    v_max = lead__screw.v_max,
    parameters = lead__screw.parameters.mimic)
    "Joint \"lead-screw\" follows joint \"shoulder\""
    annotation (Placement(transformation(extent={{16, -536}, {36, -516}})));

  UrdfSync.Sensors.Lidar a_b_c_61f936(parameters = sensorParameters.a_b_c_61f936)
    "Sensor \"a\"b\\ <c>\" of link \"table\""
    annotation (Placement(transformation(extent={{16, -1036}, {36, -1016}})));

  UrdfSync.Sensors.Lidar door(parameters = sensorParameters.door)
    "Sensor \"door\" of link \"table\""
    annotation (Placement(transformation(extent={{16, -922}, {36, -902}})));

  UrdfSync.Sensors.Imu imu(parameters = sensorParameters.imu)
    "Sensor \"imu\" of link \"chassis\""
    annotation (Placement(transformation(extent={{-60, -694}, {-40, -674}})));

  UrdfSync.Sensors.ForceTorque lift_sensor_8cfdf3(
    parameters = sensorParameters.lift_sensor_8cfdf3,
    f_joint = -lift.frame_a.R.T*(lift.frame_b.f*lift.frame_b.R.T),
    t_joint = -lift.frame_a.R.T*(lift.frame_b.t*lift.frame_b.R.T))
    "Sensor \"lift\" of joint \"lift\""
    annotation (Placement(transformation(extent={{16, -1378}, {36, -1358}})));

  UrdfSync.Sensors.ForceTorque strain(
    parameters = sensorParameters.strain,
    f_joint = shoulder.frame_a.R.T*(shoulder.frame_b.f*shoulder.frame_b.R.T),
    t_joint = shoulder.frame_a.R.T*(shoulder.frame_b.t*shoulder.frame_b.R.T))
    "Sensor \"strain\" of joint \"shoulder\""
    annotation (Placement(transformation(extent={{16, -1150}, {36, -1130}})));

  UrdfSync.Sensors.Camera table(parameters = sensorParameters.table)
    "Sensor \"table\" of link \"chassis\""
    annotation (Placement(transformation(extent={{-60, -580}, {-40, -560}})));

  UrdfSync.Sensors.ForceTorque torque(
    parameters = sensorParameters.torque,
    f_joint = -elbow.frame_b.f,
    t_joint = -elbow.frame_b.t)
    "Sensor \"torque\" of joint \"elbow\""
    annotation (Placement(transformation(extent={{76, -238}, {96, -218}})));

equation
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(liftAxis.f), lift.parameters.limits.effort)),
    getInstanceName() + ".lift (joint " + lift.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(shoulderAxis.tau), shoulder.parameters.limits.effort)),
    getInstanceName() + ".shoulder (joint " + shoulder.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  connect(frame_a, chassis.frame_a)
    annotation (Line(points={{-100, 0}, {-64, 0}, {-64, -26}, {-60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, imu.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -684}, {-60, -684}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, table.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -570}, {-60, -570}}, color={95, 95, 95}, thickness=0.5));
  connect(table.frame_b, tableFrame)
    annotation (Line(points={{-40, -570}, {-30, -570}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, lift.frame_a)
    annotation (Line(points={{-60, -26}, {-64, -26}, {-64, 0}, {-44, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(lift.frame_b, l_arm_link_6c89e3.frame_a)
    annotation (Line(points={{-24, 0}, {12, 0}, {12, -26}, {16, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, mount.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -342}, {-44, -342}}, color={95, 95, 95}, thickness=0.5));
  connect(mount.frame_b, name_641e44.frame_a)
    annotation (Line(points={{-24, -342}, {12, -342}, {12, -368}, {16, -368}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, rotational.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -1254}, {-44, -1254}}, color={95, 95, 95}, thickness=0.5));
  connect(rotational.frame_b, cON_436c9e.frame_a)
    annotation (Line(points={{-24, -1254}, {12, -1254}, {12, -1280}, {16, -1280}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, shoulder.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -114}, {-44, -114}}, color={95, 95, 95}, thickness=0.5));
  connect(shoulder.frame_b, upper_arm_99dc4e.frame_a)
    annotation (Line(points={{-24, -114}, {12, -114}, {12, -140}, {16, -140}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, table_joint_06ab04.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -456}, {-44, -456}}, color={95, 95, 95}, thickness=0.5));
  connect(table_joint_06ab04.frame_b, table_link_04a94c.frame_a)
    annotation (Line(points={{-24, -456}, {12, -456}, {12, -482}, {16, -482}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, tether.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -228}, {-44, -228}}, color={95, 95, 95}, thickness=0.5));
  connect(tether.frame_b, balloon.frame_a)
    annotation (Line(points={{-24, -228}, {12, -228}, {12, -254}, {16, -254}}, color={95, 95, 95}, thickness=0.5));
  connect(l_arm_link_6c89e3.frame_a, end_e90631.frame_a)
    annotation (Line(points={{16, -26}, {12, -26}, {12, 0}, {32, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(end_e90631.frame_b, end_847803.frame_a)
    annotation (Line(points={{52, 0}, {72, 0}, {72, -26}, {76, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(l_arm_link_6c89e3.frame_a, pinion_joint_d4c7e8.frame_a)
    annotation (Line(points={{16, -26}, {0, -26}, {0, -798}, {32, -798}}, color={95, 95, 95}, thickness=0.5));
  connect(pinion_joint_d4c7e8.frame_b, pinion_link_c664fc.frame_a)
    annotation (Line(points={{52, -798}, {72, -798}, {72, -824}, {76, -824}}, color={95, 95, 95}, thickness=0.5));
  connect(end_847803.frame_a, end_847803Frame)
    annotation (Line(points={{76, -26}, {72, -26}, {72, 0}, {102, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(pinion_link_c664fc.frame_a, pinion_link_c664fcFrame)
    annotation (Line(points={{76, -824}, {72, -824}, {72, -798}, {102, -798}}, color={95, 95, 95}, thickness=0.5));
  connect(name_641e44.frame_a, held_slide_856a5a.frame_a)
    annotation (Line(points={{16, -368}, {12, -368}, {12, -342}, {32, -342}}, color={95, 95, 95}, thickness=0.5));
  connect(held_slide_856a5a.frame_b, gelenk_a_7bf08c.frame_a)
    annotation (Line(points={{52, -342}, {72, -342}, {72, -368}, {76, -368}}, color={95, 95, 95}, thickness=0.5));
  connect(name_641e44.frame_a, held_turn_a231f5.frame_a)
    annotation (Line(points={{16, -368}, {8, -368}, {8, -684}, {32, -684}}, color={95, 95, 95}, thickness=0.5));
  connect(held_turn_a231f5.frame_b, time_2071df.frame_a)
    annotation (Line(points={{52, -684}, {72, -684}, {72, -710}, {76, -710}}, color={95, 95, 95}, thickness=0.5));
  connect(gelenk_a_7bf08c.frame_a, gelenk_a_7bf08cFrame)
    annotation (Line(points={{76, -368}, {72, -368}, {72, -342}, {102, -342}}, color={95, 95, 95}, thickness=0.5));
  connect(time_2071df.frame_a, time_2071dfFrame)
    annotation (Line(points={{76, -710}, {72, -710}, {72, -684}, {102, -684}}, color={95, 95, 95}, thickness=0.5));
  connect(cON_436c9e.frame_a, cON_436c9eFrame)
    annotation (Line(points={{16, -1280}, {12, -1280}, {12, -1254}, {42, -1254}}, color={95, 95, 95}, thickness=0.5));
  connect(upper_arm_99dc4e.frame_a, elbow.frame_a)
    annotation (Line(points={{16, -140}, {12, -140}, {12, -114}, {32, -114}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow.frame_b, l_arm_link_ff9950.frame_a)
    annotation (Line(points={{52, -114}, {72, -114}, {72, -140}, {76, -140}}, color={95, 95, 95}, thickness=0.5));
  connect(upper_arm_99dc4e.frame_a, lead__screw.frame_a)
    annotation (Line(points={{16, -140}, {4, -140}, {4, -570}, {32, -570}}, color={95, 95, 95}, thickness=0.5));
  connect(lead__screw.frame_b, nut.frame_a)
    annotation (Line(points={{52, -570}, {72, -570}, {72, -596}, {76, -596}}, color={95, 95, 95}, thickness=0.5));
  connect(l_arm_link_ff9950.frame_a, l_arm_link_ff9950Frame)
    annotation (Line(points={{76, -140}, {72, -140}, {72, -114}, {102, -114}}, color={95, 95, 95}, thickness=0.5));
  connect(nut.frame_a, nutFrame)
    annotation (Line(points={{76, -596}, {72, -596}, {72, -570}, {102, -570}}, color={95, 95, 95}, thickness=0.5));
  connect(table_link_04a94c.frame_a, a_b_c_61f936.frame_a)
    annotation (Line(points={{16, -482}, {-4, -482}, {-4, -1026}, {16, -1026}}, color={95, 95, 95}, thickness=0.5));
  connect(a_b_c_61f936.frame_b, a_b_c_61f936Frame)
    annotation (Line(points={{36, -1026}, {46, -1026}}, color={95, 95, 95}, thickness=0.5));
  connect(table_link_04a94c.frame_a, door.frame_a)
    annotation (Line(points={{16, -482}, {-4, -482}, {-4, -912}, {16, -912}}, color={95, 95, 95}, thickness=0.5));
  connect(door.frame_b, doorFrame)
    annotation (Line(points={{36, -912}, {46, -912}}, color={95, 95, 95}, thickness=0.5));
  connect(table_link_04a94c.frame_a, puck.frame_a)
    annotation (Line(points={{16, -482}, {12, -482}, {12, -456}, {32, -456}}, color={95, 95, 95}, thickness=0.5));
  connect(puck.frame_b, a_b_c_1_0_d_e_1c5357.frame_a)
    annotation (Line(points={{52, -456}, {72, -456}, {72, -482}, {76, -482}}, color={95, 95, 95}, thickness=0.5));
  connect(a_b_c_1_0_d_e_1c5357.frame_a, a_b_c_1_0_d_e_1c5357Frame)
    annotation (Line(points={{76, -482}, {72, -482}, {72, -456}, {102, -456}}, color={95, 95, 95}, thickness=0.5));
  connect(balloon.frame_a, balloonFrame)
    annotation (Line(points={{16, -254}, {12, -254}, {12, -228}, {42, -228}}, color={95, 95, 95}, thickness=0.5));
  connect(lift.axis, liftAxis)
    annotation (Line(points={{-34, 10}, {-34, 20}}, color={0, 127, 0}));
  connect(lift.support, liftSupport)
    annotation (Line(points={{-40, 10}, {-40, 12}, {-48, 12}, {-48, 20}}, color={0, 127, 0}));
  connect(rotational.axis, rotationalAxis_2)
    annotation (Line(points={{-34, -1244}, {-34, -1234}}, color={0, 0, 0}));
  connect(rotational.support, rotationalSupport_2)
    annotation (Line(points={{-40, -1244}, {-40, -1242}, {-48, -1242}, {-48, -1234}}, color={0, 0, 0}));
  connect(shoulder.axis, shoulderAxis)
    annotation (Line(points={{-34, -104}, {-34, -94}}, color={0, 0, 0}));
  connect(shoulder.support, shoulderSupport)
    annotation (Line(points={{-40, -104}, {-40, -102}, {-48, -102}, {-48, -94}}, color={0, 0, 0}));
  connect(end_e90631Mimic.follower, end_e90631.axis)
    annotation (Line(points={{36, 44}, {42, 44}, {42, 10}}, color={0, 127, 0}));
  connect(end_e90631Mimic.leader, lift.axis)
    annotation (Line(points={{16, 44}, {8, 44}, {8, 66}, {-26, 66}, {-26, 12}, {-34, 12}, {-34, 10}}, color={0, 127, 0}));
  connect(pinion_joint_d4c7e8Mimic.follower, pinion_joint_d4c7e8.axis)
    annotation (Line(points={{36, -754}, {42, -754}, {42, -788}}, color={0, 0, 0}));
  connect(pinion_joint_d4c7e8Mimic.leader, end_e90631.axis)
    annotation (Line(points={{16, -754}, {-8, -754}, {-8, 62}, {42, 62}, {42, 10}}, color={0, 127, 0}));
  connect(held_slide_856a5aMimic.follower, held_slide_856a5a.axis)
    annotation (Line(points={{36, -298}, {42, -298}, {42, -332}}, color={0, 127, 0}));
  connect(held_turn_a231f5Mimic.follower, held_turn_a231f5.axis)
    annotation (Line(points={{36, -640}, {42, -640}, {42, -674}}, color={0, 0, 0}));
  connect(elbowMimic.follower, elbow.axis)
    annotation (Line(points={{36, -70}, {42, -70}, {42, -104}}, color={0, 0, 0}));
  connect(elbowMimic.leader, shoulder.axis)
    annotation (Line(points={{16, -70}, {-12, -70}, {-12, -48}, {-26, -48}, {-26, -102}, {-34, -102}, {-34, -104}}, color={0, 0, 0}));
  connect(lead__screwMimic.follower, lead__screw.axis)
    annotation (Line(points={{36, -526}, {42, -526}, {42, -560}}, color={0, 127, 0}));
  connect(lead__screwMimic.leader, shoulder.axis)
    annotation (Line(points={{16, -526}, {-12, -526}, {-12, -48}, {-26, -48}, {-26, -102}, {-34, -102}, {-34, -104}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 370}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 370}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="lift"),
      Text(extent={{-90, 166}, {0, 184}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="rotational"),
      Text(extent={{-90, 126}, {0, 144}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="shoulder"),
      Text(extent={{0, 253}, {88, 267}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="end_847803"),
      Text(extent={{0, 293}, {88, 307}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="pinion_link_c664fc"),
      Text(extent={{0, 333}, {88, 347}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="gelenk_a_7bf08c"),
      Text(extent={{0, 173}, {88, 187}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="time_2071df"),
      Text(extent={{0, 193}, {88, 207}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="cON_436c9e"),
      Text(extent={{0, 353}, {88, 367}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="l_arm_link_ff9950"),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="nut"),
      Text(extent={{0, 273}, {88, 287}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="a_b_c_1_0_d_e_1c5357"),
      Text(extent={{0, 313}, {88, 327}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="balloon"),
      Text(extent={{0, 153}, {88, 167}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="a\"b\\ <c>"),
      Text(extent={{0, 233}, {88, 247}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="door"),
      Text(extent={{0, 133}, {88, 147}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="table")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -1440}, {136, 70}})),
    Documentation(info="<html>
<p>
Links and joints of robot Menagerie, connected. Each can be exchanged in a model that extends this one. Each joint that can be driven has two flanges for its drive: its name with <code>Axis</code> and with <code>Support</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end Menagerie;
