within Zoo.Menagerie;

model Menagerie "Robot Menagerie"
  extends UrdfSync.Robots.PartialMobileRobot;

  constant Integer rotational_jointAxis = 1
    "Number of joint \"rotational\" in rotationalAxis";

  constant Integer shoulderAxis = 2
    "Number of joint \"shoulder\" in rotationalAxis";

  constant Integer liftAxis = 1
    "Number of joint \"lift\" in translationalAxis";

  constant Integer end_linkFrame = 1
    "Number of link \"end\" in frame_b";

  constant Integer pinionFrame = 2
    "Number of link \"pinion\" in frame_b";

  constant Integer gelenk__Frame = 3
    "Number of link \"Gelenk_ä\" in frame_b";

  constant Integer time_linkFrame = 4
    "Number of link \"time\" in frame_b";

  constant Integer cON_linkFrame = 5
    "Number of link \"CON\" in frame_b";

  constant Integer l_arm_linkFrame = 6
    "Number of link \"L_arm\" in frame_b";

  constant Integer nutFrame = 7
    "Number of link \"nut\" in frame_b";

  constant Integer a_b___c_______1_0______d____eFrame = 8
    "Number of link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\" in frame_b";

  constant Integer balloonFrame = 9
    "Number of link \"balloon\" in frame_b";

  final parameter Real rotationalRange[2, 3] = {
    {-Modelica.Constants.inf, Modelica.Constants.inf, rotational_joint.parameters.limits.velocity},
    UrdfSync.Functions.leaderRange(UrdfSync.Functions.leaderRange({shoulder.parameters.limits.lower, shoulder.parameters.limits.upper, shoulder.parameters.limits.velocity}, elbow.parameters.mimic.multiplier, elbow.parameters.mimic.offset, {elbow.parameters.limits.lower, elbow.parameters.limits.upper, elbow.parameters.limits.velocity}), lead_screw.parameters.mimic.multiplier, lead_screw.parameters.mimic.offset, {lead_screw.parameters.limits.lower, lead_screw.parameters.limits.upper, lead_screw.parameters.limits.velocity})}
    "Ranges of rotationalAxis, those of joints that follow an axis included: {lower, upper, velocity}";

  parameter Modelica.Units.SI.Angle phi_start[2] = {
    UrdfSync.Functions.closestToZero(rotationalRange[1, 1], rotationalRange[1, 2]),
    UrdfSync.Functions.closestToZero(rotationalRange[2, 1], rotationalRange[2, 2])}
    "Start values of the positions"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.AngularVelocity w_start[2] = zeros(2)
    "Start values of the speeds"
    annotation (Dialog(tab="Initialization"));

  final parameter Real translationalRange[1, 3] = {
    UrdfSync.Functions.leaderRange({lift.parameters.limits.lower, lift.parameters.limits.upper, lift.parameters.limits.velocity}, end_joint.parameters.mimic.multiplier, end_joint.parameters.mimic.offset, UrdfSync.Functions.leaderRange({end_joint.parameters.limits.lower, end_joint.parameters.limits.upper, end_joint.parameters.limits.velocity}, pinion_joint.parameters.mimic.multiplier, pinion_joint.parameters.mimic.offset, {-Modelica.Constants.inf, Modelica.Constants.inf, pinion_joint.parameters.limits.velocity}))}
    "Ranges of translationalAxis, those of joints that follow an axis included: {lower, upper, velocity}";

  parameter Modelica.Units.SI.Position s_start[1] = {
    UrdfSync.Functions.closestToZero(translationalRange[1, 1], translationalRange[1, 2])}
    "Start values of the positions"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Velocity v_start[1] = zeros(1)
    "Start values of the speeds"
    annotation (Dialog(tab="Initialization"));

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

  Modelica.Mechanics.Rotational.Interfaces.Flange_a rotationalAxis[2]
    "Drives"
    annotation (Placement(transformation(extent={{-78, 70}, {-58, 90}}), iconTransformation(extent={{-70, 90}, {-50, 110}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rotationalSupport[2]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{-26, 70}, {-6, 90}}), iconTransformation(extent={{-40, 90}, {-20, 110}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a translationalAxis[1]
    "Drives"
    annotation (Placement(transformation(extent={{22, 70}, {42, 90}}), iconTransformation(extent={{20, 90}, {40, 110}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b translationalSupport[1]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{70, 70}, {90, 90}}), iconTransformation(extent={{50, 90}, {70, 110}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b[9]
    "Frames of the links without children"
    annotation (Placement(transformation(extent={{134, -16}, {166, 16}}), iconTransformation(extent={{84, -16}, {116, 16}})));

  Links.Chassis chassis(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"chassis\""
    annotation (Placement(transformation(extent={{-72, -36}, {-52, -16}})));

  Links.L_arm l_arm(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"l_arm\""
    annotation (Placement(transformation(extent={{-20, -36}, {0, -16}})));

  Links.End_link end_link(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"end\""
    annotation (Placement(transformation(extent={{28, -36}, {48, -16}})));

  Links.Pinion pinion(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"pinion\""
    annotation (Placement(transformation(extent={{28, -126}, {48, -106}})));

  Links.Name_link name_link(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"name\""
    annotation (Placement(transformation(extent={{-20, -216}, {0, -196}})));

  Links.Gelenk__ gelenk__(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"Gelenk_ä\""
    annotation (Placement(transformation(extent={{28, -216}, {48, -196}})));

  Links.Time_link time_link(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"time\""
    annotation (Placement(transformation(extent={{28, -306}, {48, -286}})));

  Links.CON_link cON_link(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"CON\""
    annotation (Placement(transformation(extent={{-20, -376}, {0, -356}})));

  Links.Upper_arm upper_arm(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"upper arm\""
    annotation (Placement(transformation(extent={{-20, -478}, {0, -458}})));

  Links.L_arm_link l_arm_link(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"L_arm\""
    annotation (Placement(transformation(extent={{28, -478}, {48, -458}})));

  Links.Nut nut(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"nut\""
    annotation (Placement(transformation(extent={{28, -568}, {48, -548}})));

  Links.Table table(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"table\""
    annotation (Placement(transformation(extent={{-20, -630}, {0, -610}})));

  Links.A_b___c_______1_0______d____e a_b___c_______1_0______d____e(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
    annotation (Placement(transformation(extent={{28, -630}, {48, -610}})));

  Links.Balloon balloon(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"balloon\""
    annotation (Placement(transformation(extent={{-20, -692}, {0, -672}})));

  Joints.Lift lift(
    axisNumber = 1,
    checkLimits = checkLimits,
    checkEffort = false,
    fixedStart = fixedStart,
    s_start = s_start[1],
    v_start = v_start[1])
    "Prismatic joint \"lift\" from link \"chassis\" to link \"l_arm\""
    annotation (Placement(transformation(extent={{-56, -10}, {-36, 10}})));

  Joints.End_joint end_joint(
    checkLimits = checkLimits,
    checkEffort = false,
    stateSelect = StateSelect.avoid,
    fixedStart = false,
    s_start = end_joint.parameters.mimic.multiplier*lift.s_start + end_joint.parameters.mimic.offset)
    "Prismatic joint \"end\" from link \"l_arm\" to link \"end\""
    annotation (Placement(transformation(extent={{-4, -10}, {16, 10}})));

  Joints.Pinion_joint pinion_joint(
    checkLimits = checkLimits,
    checkEffort = false,
    stateSelect = StateSelect.avoid,
    fixedStart = false,
    phi_start = pinion_joint.parameters.mimic.multiplier*end_joint.s_start + pinion_joint.parameters.mimic.offset)
    "Continuous joint \"pinion\" from link \"l_arm\" to link \"pinion\""
    annotation (Placement(transformation(extent={{-4, -100}, {16, -80}})));

  Joints.Mount mount
    "Fixed joint \"mount\" from link \"chassis\" to link \"name\""
    annotation (Placement(transformation(extent={{-56, -190}, {-36, -170}})));

  Joints.Held_slide held_slide(
    checkLimits = checkLimits,
    checkEffort = false,
    stateSelect = StateSelect.avoid,
    fixedStart = false,
    s_start = held_slide.parameters.mimic.offset)
    "Prismatic joint \"held slide\" from link \"name\" to link \"Gelenk_ä\""
    annotation (Placement(transformation(extent={{-4, -190}, {16, -170}})));

  Joints.Held_turn held_turn(
    checkLimits = checkLimits,
    checkEffort = false,
    stateSelect = StateSelect.avoid,
    fixedStart = false,
    phi_start = held_turn.parameters.mimic.offset)
    "Revolute joint \"held turn\" from link \"name\" to link \"time\""
    annotation (Placement(transformation(extent={{-4, -280}, {16, -260}})));

  Joints.Rotational_joint rotational_joint(
    axisNumber = 1,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[1],
    w_start = w_start[1])
    "Continuous joint \"rotational\" from link \"chassis\" to link \"CON\""
    annotation (Placement(transformation(extent={{-56, -350}, {-36, -330}})));

  Joints.Shoulder shoulder(
    axisNumber = 2,
    checkLimits = checkLimits,
    checkEffort = false,
    fixedStart = fixedStart,
    phi_start = phi_start[2],
    w_start = w_start[2])
    "Revolute joint \"shoulder\" from link \"chassis\" to link \"upper arm\""
    annotation (Placement(transformation(extent={{-56, -452}, {-36, -432}})));

  Joints.Elbow elbow(
    checkLimits = checkLimits,
    checkEffort = false,
    stateSelect = StateSelect.avoid,
    fixedStart = false,
    phi_start = elbow.parameters.mimic.multiplier*shoulder.phi_start + elbow.parameters.mimic.offset)
    "Revolute joint \"elbow\" from link \"upper arm\" to link \"L_arm\""
    annotation (Placement(transformation(extent={{-4, -452}, {16, -432}})));

  Joints.Lead_screw lead_screw(
    checkLimits = checkLimits,
    checkEffort = false,
    stateSelect = StateSelect.avoid,
    fixedStart = false,
    s_start = lead_screw.parameters.mimic.multiplier*shoulder.phi_start + lead_screw.parameters.mimic.offset)
    "Prismatic joint \"lead-screw\" from link \"upper arm\" to link \"nut\""
    annotation (Placement(transformation(extent={{-4, -542}, {16, -522}})));

  Joints.Table_joint table_joint
    "Planar joint \"table\" from link \"chassis\" to link \"table\""
    annotation (Placement(transformation(extent={{-56, -604}, {-36, -584}})));

  Joints.Puck puck
    "Planar joint \"puck\" from link \"table\" to link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
    annotation (Placement(transformation(extent={{-4, -604}, {16, -584}})));

  Joints.Tether tether
    "Floating joint \"tether\" from link \"chassis\" to link \"balloon\""
    annotation (Placement(transformation(extent={{-56, -666}, {-36, -646}})));

  UrdfSync.Couplings.TranslationalToTranslational end_jointMimic(parameters = end_joint.parameters.mimic)
    "Joint \"end\" follows joint \"lift\""
    annotation (Placement(transformation(extent={{-20, 18}, {0, 38}})));

  UrdfSync.Couplings.TranslationalToRotational pinion_jointMimic(parameters = pinion_joint.parameters.mimic)
    "Joint \"pinion\" follows joint \"end\""
    annotation (Placement(transformation(extent={{-20, -72}, {0, -52}})));

  UrdfSync.Couplings.HeldTranslational held_slideMimic(parameters = held_slide.parameters.mimic)
    "Joint \"held slide\" follows joint \"mount\""
    annotation (Placement(transformation(extent={{-20, -162}, {0, -142}})));

  UrdfSync.Couplings.HeldRotational held_turnMimic(parameters = held_turn.parameters.mimic)
    "Joint \"held turn\" follows joint \"mount\""
    annotation (Placement(transformation(extent={{-20, -252}, {0, -232}})));

  UrdfSync.Couplings.RotationalToRotational elbowMimic(parameters = elbow.parameters.mimic)
    "Joint \"elbow\" follows joint \"shoulder\""
    annotation (Placement(transformation(extent={{-20, -424}, {0, -404}})));

  UrdfSync.Couplings.RotationalToTranslational lead_screwMimic(parameters = lead_screw.parameters.mimic)
    "Joint \"lead-screw\" follows joint \"shoulder\""
    annotation (Placement(transformation(extent={{-20, -514}, {0, -494}})));

equation
  assert(not checkLimits or 0.999999*abs(rotationalAxis[2].tau) <= shoulder.parameters.limits.effort + 1e-6,
    getInstanceName() + ".shoulder (joint " + shoulder.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  assert(not checkLimits or 0.999999*abs(translationalAxis[1].f) <= lift.parameters.limits.effort + 1e-6,
    getInstanceName() + ".lift (joint " + lift.parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
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
  connect(chassis.frame_a, rotational_joint.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -340}, {-56, -340}}, color={95, 95, 95}, thickness=0.5));
  connect(rotational_joint.frame_b, cON_link.frame_a)
    annotation (Line(points={{-36, -340}, {-24, -340}, {-24, -366}, {-20, -366}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, shoulder.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -442}, {-56, -442}}, color={95, 95, 95}, thickness=0.5));
  connect(shoulder.frame_b, upper_arm.frame_a)
    annotation (Line(points={{-36, -442}, {-24, -442}, {-24, -468}, {-20, -468}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, table_joint.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -594}, {-56, -594}}, color={95, 95, 95}, thickness=0.5));
  connect(table_joint.frame_b, table.frame_a)
    annotation (Line(points={{-36, -594}, {-24, -594}, {-24, -620}, {-20, -620}}, color={95, 95, 95}, thickness=0.5));
  connect(chassis.frame_a, tether.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -656}, {-56, -656}}, color={95, 95, 95}, thickness=0.5));
  connect(tether.frame_b, balloon.frame_a)
    annotation (Line(points={{-36, -656}, {-24, -656}, {-24, -682}, {-20, -682}}, color={95, 95, 95}, thickness=0.5));
  connect(l_arm.frame_a, end_joint.frame_a)
    annotation (Line(points={{-20, -26}, {-24, -26}, {-24, 0}, {-4, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(end_joint.frame_b, end_link.frame_a)
    annotation (Line(points={{16, 0}, {24, 0}, {24, -26}, {28, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(l_arm.frame_a, pinion_joint.frame_a)
    annotation (Line(points={{-20, -26}, {-24, -26}, {-24, -90}, {-4, -90}}, color={95, 95, 95}, thickness=0.5));
  connect(pinion_joint.frame_b, pinion.frame_a)
    annotation (Line(points={{16, -90}, {24, -90}, {24, -116}, {28, -116}}, color={95, 95, 95}, thickness=0.5));
  connect(end_link.frame_a, frame_b[1])
    annotation (Line(points={{28, -26}, {24, -26}, {24, 0}, {150, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(pinion.frame_a, frame_b[2])
    annotation (Line(points={{28, -116}, {24, -116}, {24, -90}, {126, -90}, {126, 0}, {150, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(name_link.frame_a, held_slide.frame_a)
    annotation (Line(points={{-20, -206}, {-24, -206}, {-24, -180}, {-4, -180}}, color={95, 95, 95}, thickness=0.5));
  connect(held_slide.frame_b, gelenk__.frame_a)
    annotation (Line(points={{16, -180}, {24, -180}, {24, -206}, {28, -206}}, color={95, 95, 95}, thickness=0.5));
  connect(name_link.frame_a, held_turn.frame_a)
    annotation (Line(points={{-20, -206}, {-24, -206}, {-24, -270}, {-4, -270}}, color={95, 95, 95}, thickness=0.5));
  connect(held_turn.frame_b, time_link.frame_a)
    annotation (Line(points={{16, -270}, {24, -270}, {24, -296}, {28, -296}}, color={95, 95, 95}, thickness=0.5));
  connect(gelenk__.frame_a, frame_b[3])
    annotation (Line(points={{28, -206}, {24, -206}, {24, -180}, {126, -180}, {126, 0}, {150, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(time_link.frame_a, frame_b[4])
    annotation (Line(points={{28, -296}, {24, -296}, {24, -270}, {126, -270}, {126, 0}, {150, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(cON_link.frame_a, frame_b[5])
    annotation (Line(points={{-20, -366}, {-24, -366}, {-24, -340}, {126, -340}, {126, 0}, {150, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(upper_arm.frame_a, elbow.frame_a)
    annotation (Line(points={{-20, -468}, {-24, -468}, {-24, -442}, {-4, -442}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow.frame_b, l_arm_link.frame_a)
    annotation (Line(points={{16, -442}, {24, -442}, {24, -468}, {28, -468}}, color={95, 95, 95}, thickness=0.5));
  connect(upper_arm.frame_a, lead_screw.frame_a)
    annotation (Line(points={{-20, -468}, {-24, -468}, {-24, -532}, {-4, -532}}, color={95, 95, 95}, thickness=0.5));
  connect(lead_screw.frame_b, nut.frame_a)
    annotation (Line(points={{16, -532}, {24, -532}, {24, -558}, {28, -558}}, color={95, 95, 95}, thickness=0.5));
  connect(l_arm_link.frame_a, frame_b[6])
    annotation (Line(points={{28, -468}, {24, -468}, {24, -442}, {126, -442}, {126, 0}, {150, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(nut.frame_a, frame_b[7])
    annotation (Line(points={{28, -558}, {24, -558}, {24, -532}, {126, -532}, {126, 0}, {150, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(table.frame_a, puck.frame_a)
    annotation (Line(points={{-20, -620}, {-24, -620}, {-24, -594}, {-4, -594}}, color={95, 95, 95}, thickness=0.5));
  connect(puck.frame_b, a_b___c_______1_0______d____e.frame_a)
    annotation (Line(points={{16, -594}, {24, -594}, {24, -620}, {28, -620}}, color={95, 95, 95}, thickness=0.5));
  connect(a_b___c_______1_0______d____e.frame_a, frame_b[8])
    annotation (Line(points={{28, -620}, {24, -620}, {24, -594}, {126, -594}, {126, 0}, {150, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(balloon.frame_a, frame_b[9])
    annotation (Line(points={{-20, -682}, {-24, -682}, {-24, -656}, {126, -656}, {126, 0}, {150, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(lift.axis, translationalAxis[1])
    annotation (Line(points={{-46, 10}, {-46, 62}, {32, 62}, {32, 80}}, color={0, 127, 0}));
  connect(lift.support, translationalSupport[1])
    annotation (Line(points={{-52, 10}, {-52, 66}, {80, 66}, {80, 80}}, color={0, 127, 0}));
  connect(rotational_joint.axis, rotationalAxis[1])
    annotation (Line(points={{-46, -330}, {-46, -322}, {120, -322}, {120, 54}, {-68, 54}, {-68, 80}}, color={0, 0, 0}));
  connect(rotational_joint.support, rotationalSupport[1])
    annotation (Line(points={{-52, -330}, {-52, -318}, {114, -318}, {114, 58}, {-16, 58}, {-16, 80}}, color={0, 0, 0}));
  connect(shoulder.axis, rotationalAxis[2])
    annotation (Line(points={{-46, -432}, {-46, -392}, {120, -392}, {120, 54}, {-68, 54}, {-68, 80}}, color={0, 0, 0}));
  connect(shoulder.support, rotationalSupport[2])
    annotation (Line(points={{-52, -432}, {-52, -388}, {114, -388}, {114, 58}, {-16, 58}, {-16, 80}}, color={0, 0, 0}));
  connect(end_jointMimic.follower, end_joint.axis)
    annotation (Line(points={{0, 28}, {6, 28}, {6, 10}}, color={0, 127, 0}));
  connect(end_jointMimic.leader, lift.axis)
    annotation (Line(points={{-20, 28}, {-28, 28}, {-28, 50}, {-46, 50}, {-46, 10}}, color={0, 127, 0}));
  connect(pinion_jointMimic.follower, pinion_joint.axis)
    annotation (Line(points={{0, -62}, {6, -62}, {6, -80}}, color={0, 0, 0}));
  connect(pinion_jointMimic.leader, end_joint.axis)
    annotation (Line(points={{-20, -62}, {-32, -62}, {-32, 46}, {6, 46}, {6, 10}}, color={0, 127, 0}));
  connect(held_slideMimic.follower, held_slide.axis)
    annotation (Line(points={{0, -152}, {6, -152}, {6, -170}}, color={0, 127, 0}));
  connect(held_turnMimic.follower, held_turn.axis)
    annotation (Line(points={{0, -242}, {6, -242}, {6, -260}}, color={0, 0, 0}));
  connect(elbowMimic.follower, elbow.axis)
    annotation (Line(points={{0, -414}, {6, -414}, {6, -432}}, color={0, 0, 0}));
  connect(elbowMimic.leader, shoulder.axis)
    annotation (Line(points={{-20, -414}, {-28, -414}, {-28, -396}, {-46, -396}, {-46, -432}}, color={0, 0, 0}));
  connect(lead_screwMimic.follower, lead_screw.axis)
    annotation (Line(points={{0, -504}, {6, -504}, {6, -522}}, color={0, 127, 0}));
  connect(lead_screwMimic.leader, shoulder.axis)
    annotation (Line(points={{-20, -504}, {-28, -504}, {-28, -396}, {-46, -396}, {-46, -432}}, color={0, 0, 0}));

  annotation (
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -700}, {166, 90}})),
    Documentation(info="<html>
<p>
Links and joints of robot Menagerie, connected. The flange vectors hold the axes that can be driven; the constants <code>...Axis</code> and <code>...Frame</code> are their numbers, and keep their meaning when the robot changes. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end Menagerie;
