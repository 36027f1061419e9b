within Rig;

model Rig "Robot Rig"
  extends UrdfSync.Robots.PartialStationaryRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b wheel1Frame
    "Frame of link \"wheel1\""
    annotation (Placement(transformation(extent={{16, -124}, {36, -104}}), iconTransformation(extent={{92, 132}, {108, 148}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b wheel2Frame
    "Frame of link \"wheel2\""
    annotation (Placement(transformation(extent={{16, -352}, {36, -332}}), iconTransformation(extent={{92, 152}, {108, 168}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b wheel3Frame
    "Frame of link \"wheel3\""
    annotation (Placement(transformation(extent={{16, -466}, {36, -446}}), iconTransformation(extent={{92, 212}, {108, 228}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b bladeFrame
    "Frame of link \"blade\""
    annotation (Placement(transformation(extent={{76, -238}, {96, -218}}), iconTransformation(extent={{92, 192}, {108, 208}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b toolFrame
    "Frame of link \"tool\""
    annotation (Placement(transformation(extent={{316, -10}, {336, 10}}), iconTransformation(extent={{92, 172}, {108, 188}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b toothFrame
    "Frame of link \"tooth\""
    annotation (Placement(transformation(extent={{136, -124}, {156, -104}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a caster1Axis
    "Axis of joint \"caster1\""
    annotation (Placement(transformation(extent={{-40, -100}, {-28, -88}}), iconTransformation(extent={{-104, 336}, {-96, 344}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b caster1Support
    "Housing of the drive of joint \"caster1\""
    annotation (Placement(transformation(extent={{-54, -100}, {-42, -88}}), iconTransformation(extent={{-104, 326}, {-96, 334}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a caster2Axis
    "Axis of joint \"caster2\""
    annotation (Placement(transformation(extent={{-40, -328}, {-28, -316}}), iconTransformation(extent={{-104, 276}, {-96, 284}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b caster2Support
    "Housing of the drive of joint \"caster2\""
    annotation (Placement(transformation(extent={{-54, -328}, {-42, -316}}), iconTransformation(extent={{-104, 266}, {-96, 274}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a caster3Axis
    "Axis of joint \"caster3\""
    annotation (Placement(transformation(extent={{-40, -442}, {-28, -430}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b caster3Support
    "Housing of the drive of joint \"caster3\""
    annotation (Placement(transformation(extent={{-54, -442}, {-42, -430}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a waistAxis
    "Axis of joint \"waist\""
    annotation (Placement(transformation(extent={{-40, 14}, {-28, 26}}), iconTransformation(extent={{-104, 176}, {-96, 184}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b waistSupport
    "Housing of the drive of joint \"waist\""
    annotation (Placement(transformation(extent={{-54, 14}, {-42, 26}}), iconTransformation(extent={{-104, 166}, {-96, 174}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a liftAxis
    "Axis of joint \"lift\""
    annotation (Placement(transformation(extent={{20, 14}, {32, 26}}), iconTransformation(extent={{-104, 256}, {-96, 264}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b liftSupport
    "Housing of the drive of joint \"lift\""
    annotation (Placement(transformation(extent={{6, 14}, {18, 26}}), iconTransformation(extent={{-104, 246}, {-96, 254}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a pushAxis
    "Axis of joint \"push\""
    annotation (Placement(transformation(extent={{80, 14}, {92, 26}}), iconTransformation(extent={{-104, 216}, {-96, 224}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b pushSupport
    "Housing of the drive of joint \"push\""
    annotation (Placement(transformation(extent={{66, 14}, {78, 26}}), iconTransformation(extent={{-104, 206}, {-96, 214}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a tiltAxis
    "Axis of joint \"tilt\""
    annotation (Placement(transformation(extent={{140, 14}, {152, 26}}), iconTransformation(extent={{-104, 196}, {-96, 204}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b tiltSupport
    "Housing of the drive of joint \"tilt\""
    annotation (Placement(transformation(extent={{126, 14}, {138, 26}}), iconTransformation(extent={{-104, 186}, {-96, 194}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a flexAxis
    "Axis of joint \"flex\""
    annotation (Placement(transformation(extent={{200, 14}, {212, 26}}), iconTransformation(extent={{-104, 156}, {-96, 164}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b flexSupport
    "Housing of the drive of joint \"flex\""
    annotation (Placement(transformation(extent={{186, 14}, {198, 26}}), iconTransformation(extent={{-104, 146}, {-96, 154}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a rollAxis
    "Axis of joint \"roll\""
    annotation (Placement(transformation(extent={{260, 14}, {272, 26}}), iconTransformation(extent={{-104, 136}, {-96, 144}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rollSupport
    "Housing of the drive of joint \"roll\""
    annotation (Placement(transformation(extent={{246, 14}, {258, 26}}), iconTransformation(extent={{-104, 126}, {-96, 134}})));

  final parameter Modelica.Units.SI.Mass m =
    base.m +
    wheel1.m +
    wheel2.m +
    wheel3.m +
    trunk.m +
    blade.m +
    fork.m +
    plate.m +
    head.m +
    palm.m +
    tool.m +
    tooth.m
    "Mass of the whole robot";

  parameter RigStart startPositions
    "Where joints begin"
    annotation (Placement(transformation(extent={{-110, -556}, {-90, -536}})));

  parameter RigSensors sensorParameters
    "Numbers of the sensors"
    annotation (Placement(transformation(extent={{-110, -528}, {-90, -508}})));

  replaceable Links.Base base(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"base\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-60, -36}, {-40, -16}})));

  replaceable Links.Wheel1 wheel1(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"wheel1\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -150}, {20, -130}})));

  replaceable Links.Wheel2 wheel2(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"wheel2\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -378}, {20, -358}})));

  replaceable Links.Wheel3 wheel3(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"wheel3\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -492}, {20, -472}})));

  replaceable Links.Trunk trunk(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"trunk\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -36}, {20, -16}})));

  replaceable Links.Blade blade(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"blade\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -264}, {80, -244}})));

  replaceable Links.Fork fork(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"fork\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -36}, {80, -16}})));

  replaceable Links.Plate plate(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"plate\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{120, -36}, {140, -16}})));

  replaceable Links.Head head(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"head\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{180, -36}, {200, -16}})));

  replaceable Links.Palm palm(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"palm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{240, -36}, {260, -16}})));

  replaceable Links.Tool tool(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"tool\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{300, -36}, {320, -16}})));

  replaceable Links.Tooth tooth(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"tooth\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{120, -150}, {140, -130}})));

  replaceable Joints.Caster1 caster1(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"caster1\" from link \"base\" to link \"wheel1\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -124}, {-24, -104}})));

  replaceable Joints.Caster2 caster2(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"caster2\" from link \"base\" to link \"wheel2\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -352}, {-24, -332}})));

  replaceable Joints.Caster3 caster3(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"caster3\" from link \"base\" to link \"wheel3\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -466}, {-24, -446}})));

  replaceable Joints.Waist waist(
    phi_min = max({-Modelica.Constants.inf, fanMimic.leader_min}),
    phi_max = min({Modelica.Constants.inf, fanMimic.leader_max}),
    w_max = min({waist.parameters.limits.velocity, fanMimic.leaderSpeed_max}),
    phi_start = startPositions.waist,
    fixedStart = fixedStart,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_min = max({-Modelica.Constants.inf, fanMimic.leader_min}),
      phi_max = min({Modelica.Constants.inf, fanMimic.leader_max}),
      w_max = min({waist.parameters.limits.velocity, fanMimic.leaderSpeed_max}),
      phi_start = startPositions.waist,
      fixedStart = fixedStart,
      checkEffort = false,
      checkLimits = checkLimits)
    "Continuous joint \"waist\" from link \"base\" to link \"trunk\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -10}, {-24, 10}})));

  replaceable Joints.Fan fan(
    phi_start = fan.parameters.mimic.multiplier*waist.phi_start + fan.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = fan.parameters.mimic.multiplier*waist.phi_start + fan.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Revolute joint \"fan\" from link \"trunk\" to link \"blade\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -238}, {36, -218}})));

  replaceable Joints.Lift lift(
    s_min = max({lift.parameters.limits.lower, rackMimic.leader_min}),
    s_max = min({lift.parameters.limits.upper, rackMimic.leader_max}),
    v_max = min({lift.parameters.limits.velocity, rackMimic.leaderSpeed_max}),
    fixedStart = fixedStart,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_min = max({lift.parameters.limits.lower, rackMimic.leader_min}),
      s_max = min({lift.parameters.limits.upper, rackMimic.leader_max}),
      v_max = min({lift.parameters.limits.velocity, rackMimic.leaderSpeed_max}),
      fixedStart = fixedStart,
      checkEffort = false,
      checkLimits = checkLimits)
    "Prismatic joint \"lift\" from link \"trunk\" to link \"fork\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -10}, {36, 10}})));

  replaceable Joints.Push push(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Prismatic joint \"push\" from link \"fork\" to link \"plate\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{76, -10}, {96, 10}})));

  replaceable Joints.Tilt tilt(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"tilt\" from link \"plate\" to link \"head\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{136, -10}, {156, 10}})));

  replaceable Joints.Flex flex(
    fixedStart = fixedStart,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkEffort = false,
      checkLimits = checkLimits)
    "Revolute joint \"flex\" from link \"head\" to link \"palm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{196, -10}, {216, 10}})));

  replaceable Joints.Roll roll(
    fixedStart = fixedStart,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkEffort = false,
      checkLimits = checkLimits)
    "Continuous joint \"roll\" from link \"palm\" to link \"tool\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{256, -10}, {276, 10}})));

  replaceable Joints.Rack rack(
    s_start = rack.parameters.mimic.multiplier*lift.s_start + rack.parameters.mimic.offset,
    fixedStart = false,
    stateSelect = StateSelect.avoid,
    checkEffort = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_start = rack.parameters.mimic.multiplier*lift.s_start + rack.parameters.mimic.offset,
      fixedStart = false,
      stateSelect = StateSelect.avoid,
      checkEffort = false,
      checkLimits = checkLimits)
    "Prismatic joint \"rack\" from link \"fork\" to link \"tooth\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{76, -124}, {96, -104}})));

  UrdfSync.Couplings.RotationalToRotational fanMimic(
    phi_min = fan.phi_min,
    phi_max = fan.phi_max,
    w_max = fan.w_max,
    parameters = fan.parameters.mimic)
    "Joint \"fan\" follows joint \"waist\""
    annotation (Placement(transformation(extent={{0, -194}, {20, -174}})));

  UrdfSync.Couplings.TranslationalToTranslational rackMimic(
    s_min = rack.s_min,
    s_max = rack.s_max,
    v_max = rack.v_max,
    parameters = rack.parameters.mimic)
    "Joint \"rack\" follows joint \"lift\""
    annotation (Placement(transformation(extent={{60, -80}, {80, -60}})));

  UrdfSync.Drives.SharedGear flexGear(parameters = flex.parameters.transmission)
    "Gear of the motor that moves joint \"flex\" and joint \"roll\""
    annotation (Placement(transformation(extent={{180, 34}, {200, 54}})));

  UrdfSync.Drives.SharedGear rollGear(parameters = roll.parameters.transmission)
    "Gear of the motor that moves joint \"roll\" and joint \"flex\""
    annotation (Placement(transformation(extent={{240, 34}, {260, 54}})));

  UrdfSync.Sensors.ForceTorque load(
    parameters = sensorParameters.load,
    f_joint = tilt.frame_b.f,
    t_joint = tilt.frame_b.t)
    "Sensor \"load\" of joint \"tilt\""
    annotation (Placement(transformation(extent={{180, -124}, {200, -104}})));

equation
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(waistAxis.tau), waist.parameters.limits.effort)),
    getInstanceName() + ".waist (joint " + waist.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(liftAxis.f), lift.parameters.limits.effort)),
    getInstanceName() + ".lift (joint " + lift.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(flexAxis.tau), flex.parameters.limits.effort)),
    getInstanceName() + ".flex (joint " + flex.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(rollAxis.tau), roll.parameters.limits.effort)),
    getInstanceName() + ".roll (joint " + roll.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  connect(frame_a, base.frame_a)
    annotation (Line(points={{-100, 0}, {-64, 0}, {-64, -26}, {-60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(base.frame_a, caster1.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -114}, {-44, -114}}, color={95, 95, 95}, thickness=0.5));
  connect(caster1.frame_b, wheel1.frame_a)
    annotation (Line(points={{-24, -114}, {-4, -114}, {-4, -140}, {0, -140}}, color={95, 95, 95}, thickness=0.5));
  connect(base.frame_a, caster2.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -342}, {-44, -342}}, color={95, 95, 95}, thickness=0.5));
  connect(caster2.frame_b, wheel2.frame_a)
    annotation (Line(points={{-24, -342}, {-4, -342}, {-4, -368}, {0, -368}}, color={95, 95, 95}, thickness=0.5));
  connect(base.frame_a, caster3.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -456}, {-44, -456}}, color={95, 95, 95}, thickness=0.5));
  connect(caster3.frame_b, wheel3.frame_a)
    annotation (Line(points={{-24, -456}, {-4, -456}, {-4, -482}, {0, -482}}, color={95, 95, 95}, thickness=0.5));
  connect(base.frame_a, waist.frame_a)
    annotation (Line(points={{-60, -26}, {-64, -26}, {-64, 0}, {-44, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(waist.frame_b, trunk.frame_a)
    annotation (Line(points={{-24, 0}, {-4, 0}, {-4, -26}, {0, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(wheel1.frame_a, wheel1Frame)
    annotation (Line(points={{0, -140}, {-4, -140}, {-4, -114}, {26, -114}}, color={95, 95, 95}, thickness=0.5));
  connect(wheel2.frame_a, wheel2Frame)
    annotation (Line(points={{0, -368}, {-4, -368}, {-4, -342}, {26, -342}}, color={95, 95, 95}, thickness=0.5));
  connect(wheel3.frame_a, wheel3Frame)
    annotation (Line(points={{0, -482}, {-4, -482}, {-4, -456}, {26, -456}}, color={95, 95, 95}, thickness=0.5));
  connect(trunk.frame_a, fan.frame_a)
    annotation (Line(points={{0, -26}, {-8, -26}, {-8, -228}, {16, -228}}, color={95, 95, 95}, thickness=0.5));
  connect(fan.frame_b, blade.frame_a)
    annotation (Line(points={{36, -228}, {56, -228}, {56, -254}, {60, -254}}, color={95, 95, 95}, thickness=0.5));
  connect(trunk.frame_a, lift.frame_a)
    annotation (Line(points={{0, -26}, {-4, -26}, {-4, 0}, {16, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(lift.frame_b, fork.frame_a)
    annotation (Line(points={{36, 0}, {56, 0}, {56, -26}, {60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(blade.frame_a, bladeFrame)
    annotation (Line(points={{60, -254}, {56, -254}, {56, -228}, {86, -228}}, color={95, 95, 95}, thickness=0.5));
  connect(fork.frame_a, push.frame_a)
    annotation (Line(points={{60, -26}, {56, -26}, {56, 0}, {76, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(push.frame_b, plate.frame_a)
    annotation (Line(points={{96, 0}, {116, 0}, {116, -26}, {120, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(fork.frame_a, rack.frame_a)
    annotation (Line(points={{60, -26}, {52, -26}, {52, -114}, {76, -114}}, color={95, 95, 95}, thickness=0.5));
  connect(rack.frame_b, tooth.frame_a)
    annotation (Line(points={{96, -114}, {116, -114}, {116, -140}, {120, -140}}, color={95, 95, 95}, thickness=0.5));
  connect(plate.frame_a, tilt.frame_a)
    annotation (Line(points={{120, -26}, {116, -26}, {116, 0}, {136, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(tilt.frame_b, head.frame_a)
    annotation (Line(points={{156, 0}, {176, 0}, {176, -26}, {180, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(head.frame_a, flex.frame_a)
    annotation (Line(points={{180, -26}, {176, -26}, {176, 0}, {196, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(flex.frame_b, palm.frame_a)
    annotation (Line(points={{216, 0}, {236, 0}, {236, -26}, {240, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(palm.frame_a, roll.frame_a)
    annotation (Line(points={{240, -26}, {236, -26}, {236, 0}, {256, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(roll.frame_b, tool.frame_a)
    annotation (Line(points={{276, 0}, {296, 0}, {296, -26}, {300, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(tool.frame_a, toolFrame)
    annotation (Line(points={{300, -26}, {296, -26}, {296, 0}, {326, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(tooth.frame_a, toothFrame)
    annotation (Line(points={{120, -140}, {116, -140}, {116, -114}, {146, -114}}, color={95, 95, 95}, thickness=0.5));
  connect(caster1.axis, caster1Axis)
    annotation (Line(points={{-34, -104}, {-34, -94}}, color={0, 0, 0}));
  connect(caster1.support, caster1Support)
    annotation (Line(points={{-40, -104}, {-40, -102}, {-48, -102}, {-48, -94}}, color={0, 0, 0}));
  connect(caster2.axis, caster2Axis)
    annotation (Line(points={{-34, -332}, {-34, -322}}, color={0, 0, 0}));
  connect(caster2.support, caster2Support)
    annotation (Line(points={{-40, -332}, {-40, -330}, {-48, -330}, {-48, -322}}, color={0, 0, 0}));
  connect(caster3.axis, caster3Axis)
    annotation (Line(points={{-34, -446}, {-34, -436}}, color={0, 0, 0}));
  connect(caster3.support, caster3Support)
    annotation (Line(points={{-40, -446}, {-40, -444}, {-48, -444}, {-48, -436}}, color={0, 0, 0}));
  connect(waist.axis, waistAxis)
    annotation (Line(points={{-34, 10}, {-34, 20}}, color={0, 0, 0}));
  connect(waist.support, waistSupport)
    annotation (Line(points={{-40, 10}, {-40, 12}, {-48, 12}, {-48, 20}}, color={0, 0, 0}));
  connect(lift.axis, liftAxis)
    annotation (Line(points={{26, 10}, {26, 20}}, color={0, 127, 0}));
  connect(lift.support, liftSupport)
    annotation (Line(points={{20, 10}, {20, 12}, {12, 12}, {12, 20}}, color={0, 127, 0}));
  connect(push.axis, pushAxis)
    annotation (Line(points={{86, 10}, {86, 20}}, color={0, 127, 0}));
  connect(push.support, pushSupport)
    annotation (Line(points={{80, 10}, {80, 12}, {72, 12}, {72, 20}}, color={0, 127, 0}));
  connect(tilt.axis, tiltAxis)
    annotation (Line(points={{146, 10}, {146, 20}}, color={0, 0, 0}));
  connect(tilt.support, tiltSupport)
    annotation (Line(points={{140, 10}, {140, 12}, {132, 12}, {132, 20}}, color={0, 0, 0}));
  connect(flex.axis, flexAxis)
    annotation (Line(points={{206, 10}, {206, 20}}, color={0, 0, 0}));
  connect(flex.support, flexSupport)
    annotation (Line(points={{200, 10}, {200, 12}, {192, 12}, {192, 20}}, color={0, 0, 0}));
  connect(roll.axis, rollAxis)
    annotation (Line(points={{266, 10}, {266, 20}}, color={0, 0, 0}));
  connect(roll.support, rollSupport)
    annotation (Line(points={{260, 10}, {260, 12}, {252, 12}, {252, 20}}, color={0, 0, 0}));
  connect(fanMimic.follower, fan.axis)
    annotation (Line(points={{20, -184}, {26, -184}, {26, -218}}, color={0, 0, 0}));
  connect(fanMimic.leader, waist.axis)
    annotation (Line(points={{0, -184}, {-12, -184}, {-12, 66}, {-26, 66}, {-26, 12}, {-34, 12}, {-34, 10}}, color={0, 0, 0}));
  connect(rackMimic.follower, rack.axis)
    annotation (Line(points={{80, -70}, {86, -70}, {86, -104}}, color={0, 127, 0}));
  connect(rackMimic.leader, lift.axis)
    annotation (Line(points={{60, -70}, {48, -70}, {48, 62}, {34, 62}, {34, 12}, {26, 12}, {26, 10}}, color={0, 127, 0}));
  connect(flexGear.flange_b, flex.axis)
    annotation (Line(points={{200, 44}, {214, 44}, {214, 12}, {206, 12}, {206, 10}}, color={0, 0, 0}));
  connect(flexGear.flange_c, roll.axis)
    annotation (Line(points={{180, 44}, {172, 44}, {172, 66}, {274, 66}, {274, 12}, {266, 12}, {266, 10}}, color={0, 0, 0}));
  connect(rollGear.flange_b, roll.axis)
    annotation (Line(points={{260, 44}, {274, 44}, {274, 12}, {266, 12}, {266, 10}}, color={0, 0, 0}));
  connect(rollGear.flange_c, flex.axis)
    annotation (Line(points={{240, 44}, {232, 44}, {232, 62}, {214, 62}, {214, 12}, {206, 12}, {206, 10}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 350}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 350}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 326}, {0, 344}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="caster1"),
      Text(extent={{-90, 266}, {0, 284}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="caster2"),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="caster3"),
      Text(extent={{-90, 166}, {0, 184}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="waist"),
      Text(extent={{-90, 246}, {0, 264}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="lift"),
      Text(extent={{-90, 206}, {0, 224}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="push"),
      Text(extent={{-90, 186}, {0, 204}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="tilt"),
      Text(extent={{-90, 146}, {0, 164}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="flex"),
      Text(extent={{-90, 126}, {0, 144}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="roll"),
      Text(extent={{0, 133}, {88, 147}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="wheel1"),
      Text(extent={{0, 153}, {88, 167}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="wheel2"),
      Text(extent={{0, 213}, {88, 227}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="wheel3"),
      Text(extent={{0, 193}, {88, 207}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="blade"),
      Text(extent={{0, 173}, {88, 187}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="tool"),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="tooth")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -556}, {360, 70}})),
    Documentation(info="<html>
<p>
Links and joints of robot Rig, connected. Each can be exchanged in a model that extends this one. Each joint that can be driven has two flanges for its drive: its name with <code>Axis</code> and with <code>Support</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end Rig;
