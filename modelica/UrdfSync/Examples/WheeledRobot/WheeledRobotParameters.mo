within UrdfSync.Examples.WheeledRobot;

record WheeledRobotParameters "Numbers of robot WheeledRobot as a whole"
  extends UrdfSync.Records.Robot(
    name = "wheeled_robot",
    standingHeight = 0.100000000536,
    connectionMatrix = [1, 2; 2, 3; 1, 4; 1, 5; 1, 6; 6, 7; 7, 8; 8, 9; 9, 10; 1, 11; 11, 12],
    moveableJoints = [1, 1; 2, 1; 3, 1; 4, 1; 6, 1; 7, 1; 8, 1; 11, 1]);

  UrdfSync.Records.Link base_link(
    name = "base_link",
    inertial(
      origin(
        xyz = {-0.0561, 0, 0.0403},
        rpy = {0, 0, 0}),
      mass = 24,
      inertia(
        ixx = 0.24442,
        iyy = 0.51001,
        izz = 0.65522,
        ixy = 0,
        ixz = 0.02003,
        iyz = 0)))
    "Link 1: \"base_link\"";

  UrdfSync.Records.Link caster_fork(
    name = "caster_fork",
    inertial(
      origin(
        xyz = {-0.00606, 0, -0.01639},
        rpy = {0, 0.688, 0}),
      mass = 0.32,
      inertia(
        ixx = 0.00020282,
        iyy = 0.000171,
        izz = 0.0001047,
        ixy = 0,
        ixz = -1e-08,
        iyz = 0)))
    "Link 2: \"caster_fork\"";

  UrdfSync.Records.Link caster_wheel(
    name = "caster_wheel",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.2,
      inertia(
        ixx = 8.917e-05,
        iyy = 0.00015426,
        izz = 8.917e-05,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 3: \"caster_wheel\"";

  UrdfSync.Records.Link wheel_left(
    name = "wheel_left",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1.6,
      inertia(
        ixx = 0.0031481,
        iyy = 0.0058284,
        izz = 0.0031481,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 4: \"wheel_left\"";

  UrdfSync.Records.Link wheel_right(
    name = "wheel_right",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1.6,
      inertia(
        ixx = 0.0031481,
        iyy = 0.0058284,
        izz = 0.0031481,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 5: \"wheel_right\"";

  UrdfSync.Records.Link column_guide(
    name = "column_guide",
    inertial(
      origin(
        xyz = {-0.0041, 0, 0.1939},
        rpy = {0, 0, 0}),
      mass = 3.6,
      inertia(
        ixx = 0.062894,
        iyy = 0.064336,
        izz = 0.005759,
        ixy = 0,
        ixz = -0.001689,
        iyz = 0)))
    "Link 6: \"column_guide\"";

  UrdfSync.Records.Link column(
    name = "column",
    inertial(
      origin(
        xyz = {0, 0, -0.2065},
        rpy = {0, 0, 0}),
      mass = 2.1,
      inertia(
        ixx = 0.032383,
        iyy = 0.032588,
        izz = 0.001344,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 7: \"column\"";

  UrdfSync.Records.Link neck(
    name = "neck",
    inertial(
      origin(
        xyz = {0, 0, 0.0431},
        rpy = {0, 0, 0}),
      mass = 0.75,
      inertia(
        ixx = 0.0045072,
        iyy = 0.0010468,
        izz = 0.0038265,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 8: \"neck\"";

  UrdfSync.Records.Link head(
    name = "head",
    inertial(
      origin(
        xyz = {0.0114, 0, 0.0051},
        rpy = {0, 0, 0}),
      mass = 1.1,
      inertia(
        ixx = 0.0028147,
        iyy = 0.0013752,
        izz = 0.0031607,
        ixy = 0,
        ixz = 1.7e-06,
        iyz = 0)))
    "Link 9: \"head\"";

  UrdfSync.Records.Link camera_optical_frame(
    name = "camera_optical_frame")
    "Link 10: \"camera_optical_frame\"";

  UrdfSync.Records.Link lidar_mast(
    name = "lidar_mast",
    inertial(
      origin(
        xyz = {0, 0, 0.08288},
        rpy = {0, 0, 0}),
      mass = 0.62,
      inertia(
        ixx = 0.0019074,
        iyy = 0.0019074,
        izz = 0.0003291,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 11: \"lidar_mast\"";

  UrdfSync.Records.Link lidar(
    name = "lidar",
    inertial(
      origin(
        xyz = {0.00121, 0, 0.01922},
        rpy = {0, 0, 0}),
      mass = 0.21,
      inertia(
        ixx = 8.814e-05,
        iyy = 9.519e-05,
        izz = 0.00013079,
        ixy = 0,
        ixz = 8.2e-07,
        iyz = 0)))
    "Link 12: \"lidar\"";

  UrdfSync.Records.ContinuousJoint caster_swivel(
    name = "caster_swivel",
    origin(
      xyz = {-0.25, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf),
    dynamics(
      damping = 0.01,
      friction = 0.03))
    "Joint 1: \"caster_swivel\"";

  UrdfSync.Records.ContinuousJoint caster_roll(
    name = "caster_roll",
    origin(
      xyz = {-0.03, 0, -0.06},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf),
    dynamics(
      damping = 0.002,
      friction = 0.01))
    "Joint 2: \"caster_roll\"";

  UrdfSync.Records.ContinuousJoint drive_left(
    name = "drive_left",
    origin(
      xyz = {0, 0.205, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = 15,
      effort = 14),
    dynamics(
      damping = 0.06,
      friction = 0.25))
    "Joint 3: \"drive_left\"";

  UrdfSync.Records.ContinuousJoint drive_right(
    name = "drive_right",
    origin(
      xyz = {0, -0.205, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = 15,
      effort = 14),
    dynamics(
      damping = 0.06,
      friction = 0.25))
    "Joint 4: \"drive_right\"";

  UrdfSync.Records.FixedJoint guide_mount(
    name = "guide_mount",
    origin(
      xyz = {-0.12, 0, 0.118},
      rpy = {0, 0, 0}))
    "Joint 5: \"guide_mount\"";

  UrdfSync.Records.PrismaticJoint lift(
    name = "lift",
    origin(
      xyz = {0, 0, 0.45},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = 0,
      upper = 0.35,
      velocity = 0.08,
      effort = 300),
    dynamics(
      damping = 220,
      friction = 24),
    calibration(
      rising = Modelica.Constants.inf,
      falling = 0),
    safetyController(
      k_velocity = 2000,
      k_position = 15,
      soft_lower_limit = 0.005,
      soft_upper_limit = 0.345))
    "Joint 6: \"lift\"";

  UrdfSync.Records.RevoluteJoint head_pan(
    name = "head_pan",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -2.793,
      upper = 2.793,
      velocity = 3.5,
      effort = 6),
    dynamics(
      damping = 0.12,
      friction = 0.15),
    safetyController(
      k_velocity = 4,
      k_position = 30,
      soft_lower_limit = -2.705,
      soft_upper_limit = 2.705))
    "Joint 7: \"head_pan\"";

  UrdfSync.Records.RevoluteJoint head_tilt(
    name = "head_tilt",
    origin(
      xyz = {0, 0, 0.1},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -0.698,
      upper = 1.047,
      velocity = 3.5,
      effort = 4),
    dynamics(
      damping = 0.08,
      friction = 0.1),
    safetyController(
      k_velocity = 3,
      k_position = 30,
      soft_lower_limit = -0.61,
      soft_upper_limit = 0.96))
    "Joint 8: \"head_tilt\"";

  UrdfSync.Records.FixedJoint camera_mount(
    name = "camera_mount",
    origin(
      xyz = {0.07, 0.042, 0.005},
      rpy = {-1.5707963, 0, -1.5707963}))
    "Joint 9: \"camera_mount\"";

  UrdfSync.Records.FixedJoint mast_mount(
    name = "mast_mount",
    origin(
      xyz = {0.1, 0, 0.11},
      rpy = {0, 0, 0}))
    "Joint 10: \"mast_mount\"";

  UrdfSync.Records.ContinuousJoint lidar_spin(
    name = "lidar_spin",
    origin(
      xyz = {0, 0, 0.15},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = 63,
      effort = 0.12),
    dynamics(
      damping = 0.0004,
      friction = 0.002))
    "Joint 11: \"lidar_spin\"";

  annotation (Documentation(info="<html>
<p>
All numbers of robot WheeledRobot in one record. The robot model takes its numbers from the records of its links and joints; this one is for studies that need them all.
</p>
</html>"));
end WheeledRobotParameters;
