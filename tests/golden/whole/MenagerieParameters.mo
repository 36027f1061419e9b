within Zoo.Menagerie;

record MenagerieParameters "Numbers of robot Menagerie as a whole"
  extends UrdfSync.Records.Robot(
    name = "menagerie \"of\" <everything>",
    connectionMatrix = [1, 2; 2, 3; 2, 4; 1, 5; 5, 6; 5, 7; 1, 8; 1, 9; 9, 10; 9, 11; 1, 12; 12, 13; 1, 14],
    moveableJoints = [1, 1; 2, 1; 3, 1; 5, 1; 6, 1; 7, 1; 8, 1; 9, 1; 10, 1; 11, 1; 12, 1; 13, 1]);

  UrdfSync.Records.Link chassis(
    name = "chassis",
    inertial(
      origin(
        xyz = {0.01, -0.02, 0.03},
        rpy = {0.1, -0.2, 0.3}),
      mass = 12.5,
      inertia(
        ixx = 0.3,
        iyy = 0.25,
        izz = 0.2,
        ixy = 0.001,
        ixz = -0.002,
        iyz = 1e-05)))
    "Link 1: \"chassis\"";

  UrdfSync.Records.Box chassisVisual1(
    origin(
      xyz = {0, 0, 0.05},
      rpy = {0, 0, 1.5707963267948966}),
    size = {0.6, 0.4, 0.1},
    color = {128, 128, 140},
    opacity = 1)
    "Visual 1: \"tub\" of link \"chassis\"";

  UrdfSync.Records.Cylinder chassisVisual2(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.1,
    length = 0.3,
    color = {255, 0, 128},
    opacity = 0.25)
    "Visual 2 of link \"chassis\"";

  UrdfSync.Records.Capsule chassisVisual3(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.02,
    length = 0.4,
    color = {180, 180, 180},
    opacity = 1)
    "Visual 3: \"bumper \"front\"\" of link \"chassis\"";

  UrdfSync.Records.Sphere chassisVisual4(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.05,
    color = {180, 180, 180},
    opacity = 1)
    "Visual 4 of link \"chassis\"";

  UrdfSync.Records.Mesh chassisVisual5(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://Zoo.Menagerie/Resources/wedge_a859fdbe.obj",
    lower = {0, 0, 0},
    upper = {0.2, 0.1, 0.05},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 5: \"wedge\" of link \"chassis\"";

  UrdfSync.Records.Mesh chassisVisual7(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://Zoo.Menagerie/Resources/wedge_a691ff4a.stl",
    lower = {0, 0, -0.05},
    upper = {0.4, 0.2, 0},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 7: \"ramp\" of link \"chassis\"";

  UrdfSync.Records.Link l_arm_link_6c89e3(
    name = "l_arm",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 2,
      inertia(
        ixx = 0.02,
        iyy = 0.02,
        izz = 0.02,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 2: \"l_arm\"";

  UrdfSync.Records.Link end_847803(
    name = "end",
    hasInertial = false)
    "Link 3: \"end\"";

  UrdfSync.Records.Link pinion_link_c664fc(
    name = "pinion",
    hasInertial = false)
    "Link 4: \"pinion\"";

  UrdfSync.Records.Link name_641e44(
    name = "name",
    hasInertial = false)
    "Link 5: \"name\"";

  UrdfSync.Records.Link gelenk_a_7bf08c(
    name = "Gelenk_ä",
    hasInertial = false)
    "Link 6: \"Gelenk_ä\"";

  UrdfSync.Records.Link time_2071df(
    name = "time",
    hasInertial = false)
    "Link 7: \"time\"";

  UrdfSync.Records.Link cON_436c9e(
    name = "CON",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1,
      inertia(
        ixx = 0.01,
        iyy = 0.01,
        izz = 0.02,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 8: \"CON\"";

  UrdfSync.Records.Cylinder cON_436c9eVisual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.15,
    length = 0.04,
    color = {128, 128, 140},
    opacity = 1)
    "Visual 1 of link \"CON\"";

  UrdfSync.Records.Link upper_arm_99dc4e(
    name = "upper arm",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 3,
      inertia(
        ixx = 0.01,
        iyy = 0.01,
        izz = 0.01,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 9: \"upper arm\"";

  UrdfSync.Records.Link l_arm_link_ff9950(
    name = "L_arm",
    hasInertial = false)
    "Link 10: \"L_arm\"";

  UrdfSync.Records.Link nut(
    name = "nut",
    hasInertial = false)
    "Link 11: \"nut\"";

  UrdfSync.Records.Link table_link_04a94c(
    name = "table",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.5,
      inertia(
        ixx = 0.001,
        iyy = 0.001,
        izz = 0.001,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 12: \"table\"";

  UrdfSync.Records.Link a_b_c_1_0_d_e_1c5357(
    name = "a\"b\\ <c> & << 1/0 >> {{d}} %e",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.25,
      inertia(
        ixx = 0.001,
        iyy = 0.001,
        izz = 0.001,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 13: \"a\"b\\ <c> & << 1/0 >> {{d}} %e\"";

  UrdfSync.Records.Link balloon(
    name = "balloon",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.1,
      inertia(
        ixx = 0.001,
        iyy = 0.001,
        izz = 0.001,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 14: \"balloon\"";

  UrdfSync.Records.PrismaticJoint lift(
    name = "lift",
    origin(
      xyz = {-0.2, 0, 0.1},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -0.05,
      upper = 0.4,
      velocity = 0.25,
      effort = 500),
    dynamics(
      damping = 100,
      friction = 0),
    calibration(
      rising = Modelica.Constants.inf,
      falling = 0.35),
    safetyController(
      k_velocity = 5,
      k_position = 0,
      soft_lower_limit = 0,
      soft_upper_limit = 0))
    "Joint 1: \"lift\"";

  UrdfSync.Records.PrismaticJoint end_e90631(
    name = "end",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 1,
      effort = 5),
    dynamics(
      damping = 2,
      friction = 0.5),
    mimic(
      multiplier = 1,
      offset = 0))
    "Joint 2: \"end\"";

  UrdfSync.Records.ContinuousJoint pinion_joint_d4c7e8(
    name = "pinion",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf),
    mimic(
      multiplier = 80,
      offset = 0))
    "Joint 3: \"pinion\"";

  UrdfSync.Records.FixedJoint mount(
    name = "mount",
    origin(
      xyz = {0, 0, 0.2},
      rpy = {0, 0, 0}))
    "Joint 4: \"mount\"";

  UrdfSync.Records.PrismaticJoint held_slide_856a5a(
    name = "held slide",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 1,
      effort = 1),
    mimic(
      multiplier = 1,
      offset = 0.125))
    "Joint 5: \"held slide\"";

  UrdfSync.Records.RevoluteJoint held_turn_a231f5(
    name = "held turn",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 1,
      effort = 1),
    mimic(
      multiplier = 1,
      offset = 0.25))
    "Joint 6: \"held turn\"";

  UrdfSync.Records.ContinuousJoint rotational(
    name = "rotational",
    origin(
      xyz = {0, 0.25, -0.05},
      rpy = {-1.5707963267948966, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = 30,
      effort = 12),
    dynamics(
      damping = 0,
      friction = 0.01),
    calibration(
      rising = 0.5,
      falling = Modelica.Constants.inf),
    safetyController(
      k_velocity = 0.5,
      k_position = 0,
      soft_lower_limit = 0,
      soft_upper_limit = 0))
    "Joint 7: \"rotational\"";

  UrdfSync.Records.RevoluteJoint shoulder(
    name = "shoulder",
    origin(
      xyz = {0.2, 0, 0.1},
      rpy = {0, 0.5, 0}),
    axis = {0, 1, 0},
    limits(
      lower = 0.25,
      upper = 2.5,
      velocity = 1.5,
      effort = 150),
    dynamics(
      damping = 0.5,
      friction = 1.25),
    calibration(
      rising = 0.3,
      falling = 2.4),
    safetyController(
      k_velocity = 10,
      k_position = 20,
      soft_lower_limit = 0.3,
      soft_upper_limit = 2.4))
    "Joint 8: \"shoulder\"";

  UrdfSync.Records.RevoluteJoint elbow(
    name = "elbow",
    origin(
      xyz = {0.3, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -2,
      upper = 0,
      velocity = 2,
      effort = 80),
    mimic(
      multiplier = -0.5,
      offset = 0.1))
    "Joint 9: \"elbow\"";

  UrdfSync.Records.PrismaticJoint lead__screw(
    name = "lead-screw",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = 0,
      upper = 0.1,
      velocity = 0.1,
      effort = 20),
    mimic(
      multiplier = 0.02,
      offset = 0))
    "Joint 10: \"lead-screw\"";

  UrdfSync.Records.PlanarJoint table_joint_06ab04(
    name = "table",
    origin(
      xyz = {0, 0, 0.4},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    translation(
      damping = 4,
      friction = 2),
    rotation(
      damping = 4,
      friction = 2))
    "Joint 11: \"table\"";

  UrdfSync.Records.PlanarJoint puck(
    name = "puck",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1})
    "Joint 12: \"puck\"";

  UrdfSync.Records.FloatingJoint tether(
    name = "tether",
    origin(
      xyz = {0, 0, 1},
      rpy = {0, 0, 0}))
    "Joint 13: \"tether\"";

  annotation (Documentation(info="<html>
<p>
All numbers of robot Menagerie in one record, for studies that need them all. <code>UrdfSync.Robots.GenericRobot</code> can't take it, since a joint is planar, floating or a ball. Where the package has models of the links and joints, these read the records of their elements, and the numbers here are a copy: an edit here changes no such model.
</p>
</html>"));
end MenagerieParameters;
