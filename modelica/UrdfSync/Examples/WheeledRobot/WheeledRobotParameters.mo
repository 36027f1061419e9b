within UrdfSync.Examples.WheeledRobot;

record WheeledRobotParameters "Numbers of robot WheeledRobot as a whole"
  extends UrdfSync.Records.Robot(
    name = "wheeled_robot",
    standingHeight = 0.100000000536,
    connectionMatrix = [1, 2; 2, 3; 1, 4; 1, 5; 1, 6; 6, 7; 7, 8; 8, 9; 9, 10; 1, 11; 11, 12],
    moveableJoints = [1, 1; 2, 1; 3, 1; 4, 1; 6, 1; 7, 1; 8, 1; 11, 1],
    movingJoints = 8,
    turningJoints = 7,
    slidingJoints = 1,
    rotationalAxes = 7,
    translationalAxes = 1,
    jointTree = {{1, 1}, {2, 1}, {1, 1}, {1, 1}, {1, 2}, {6, 1}, {7, 1}, {1, 1}},
    firstJoints = {1, 2, 9, 9, 9, 6, 7, 9, 9},
    nextJoints = {3, 9, 4, 5, 8, 9, 9, 9},
    linkBodies = {
      1, 2, 3, 4, 5, 1, 6, 7, 8, 8,
      1, 9},
    turning = {1, 2, 3, 4, 6, 7, 8},
    sliding = {5},
    rotationalJoints = {1, 2, 3, 4, 6, 7, 8},
    translationalJoints = {5},
    jointAxes = {
      caster_swivel.axis,
      caster_roll.axis,
      drive_left.axis,
      drive_right.axis,
      lift.axis,
      head_pan.axis,
      head_tilt.axis,
      lidar_spin.axis},
    jointPositions = {
      caster_swivel.origin.xyz,
      caster_roll.origin.xyz,
      drive_left.origin.xyz,
      drive_right.origin.xyz,
      guide_mount.origin.xyz,
      lift.origin.xyz,
      head_pan.origin.xyz,
      head_tilt.origin.xyz,
      camera_mount.origin.xyz,
      mast_mount.origin.xyz,
      lidar_spin.origin.xyz},
    jointAngles = {
      caster_swivel.origin.rpy,
      caster_roll.origin.rpy,
      drive_left.origin.rpy,
      drive_right.origin.rpy,
      guide_mount.origin.rpy,
      lift.origin.rpy,
      head_pan.origin.rpy,
      head_tilt.origin.rpy,
      camera_mount.origin.rpy,
      mast_mount.origin.rpy,
      lidar_spin.origin.rpy},
    linkMasses = {
      base_link.inertial.mass,
      caster_fork.inertial.mass,
      caster_wheel.inertial.mass,
      wheel_left.inertial.mass,
      wheel_right.inertial.mass,
      column_guide.inertial.mass,
      column.inertial.mass,
      neck.inertial.mass,
      head.inertial.mass,
      camera_optical_frame.inertial.mass,
      lidar_mast.inertial.mass,
      lidar.inertial.mass},
    linkCenters = {
      base_link.inertial.origin.xyz,
      caster_fork.inertial.origin.xyz,
      caster_wheel.inertial.origin.xyz,
      wheel_left.inertial.origin.xyz,
      wheel_right.inertial.origin.xyz,
      column_guide.inertial.origin.xyz,
      column.inertial.origin.xyz,
      neck.inertial.origin.xyz,
      head.inertial.origin.xyz,
      camera_optical_frame.inertial.origin.xyz,
      lidar_mast.inertial.origin.xyz,
      lidar.inertial.origin.xyz},
    inertialAngles = {
      base_link.inertial.origin.rpy,
      caster_fork.inertial.origin.rpy,
      caster_wheel.inertial.origin.rpy,
      wheel_left.inertial.origin.rpy,
      wheel_right.inertial.origin.rpy,
      column_guide.inertial.origin.rpy,
      column.inertial.origin.rpy,
      neck.inertial.origin.rpy,
      head.inertial.origin.rpy,
      camera_optical_frame.inertial.origin.rpy,
      lidar_mast.inertial.origin.rpy,
      lidar.inertial.origin.rpy},
    linkInertias = {
      {base_link.inertial.inertia.ixx, base_link.inertial.inertia.iyy, base_link.inertial.inertia.izz,
       base_link.inertial.inertia.ixy, base_link.inertial.inertia.ixz, base_link.inertial.inertia.iyz},
      {caster_fork.inertial.inertia.ixx, caster_fork.inertial.inertia.iyy, caster_fork.inertial.inertia.izz,
       caster_fork.inertial.inertia.ixy, caster_fork.inertial.inertia.ixz, caster_fork.inertial.inertia.iyz},
      {caster_wheel.inertial.inertia.ixx, caster_wheel.inertial.inertia.iyy, caster_wheel.inertial.inertia.izz,
       caster_wheel.inertial.inertia.ixy, caster_wheel.inertial.inertia.ixz, caster_wheel.inertial.inertia.iyz},
      {wheel_left.inertial.inertia.ixx, wheel_left.inertial.inertia.iyy, wheel_left.inertial.inertia.izz,
       wheel_left.inertial.inertia.ixy, wheel_left.inertial.inertia.ixz, wheel_left.inertial.inertia.iyz},
      {wheel_right.inertial.inertia.ixx, wheel_right.inertial.inertia.iyy, wheel_right.inertial.inertia.izz,
       wheel_right.inertial.inertia.ixy, wheel_right.inertial.inertia.ixz, wheel_right.inertial.inertia.iyz},
      {column_guide.inertial.inertia.ixx, column_guide.inertial.inertia.iyy, column_guide.inertial.inertia.izz,
       column_guide.inertial.inertia.ixy, column_guide.inertial.inertia.ixz, column_guide.inertial.inertia.iyz},
      {column.inertial.inertia.ixx, column.inertial.inertia.iyy, column.inertial.inertia.izz,
       column.inertial.inertia.ixy, column.inertial.inertia.ixz, column.inertial.inertia.iyz},
      {neck.inertial.inertia.ixx, neck.inertial.inertia.iyy, neck.inertial.inertia.izz,
       neck.inertial.inertia.ixy, neck.inertial.inertia.ixz, neck.inertial.inertia.iyz},
      {head.inertial.inertia.ixx, head.inertial.inertia.iyy, head.inertial.inertia.izz,
       head.inertial.inertia.ixy, head.inertial.inertia.ixz, head.inertial.inertia.iyz},
      {camera_optical_frame.inertial.inertia.ixx, camera_optical_frame.inertial.inertia.iyy, camera_optical_frame.inertial.inertia.izz,
       camera_optical_frame.inertial.inertia.ixy, camera_optical_frame.inertial.inertia.ixz, camera_optical_frame.inertial.inertia.iyz},
      {lidar_mast.inertial.inertia.ixx, lidar_mast.inertial.inertia.iyy, lidar_mast.inertial.inertia.izz,
       lidar_mast.inertial.inertia.ixy, lidar_mast.inertial.inertia.ixz, lidar_mast.inertial.inertia.iyz},
      {lidar.inertial.inertia.ixx, lidar.inertial.inertia.iyy, lidar.inertial.inertia.izz,
       lidar.inertial.inertia.ixy, lidar.inertial.inertia.ixz, lidar.inertial.inertia.iyz}},
    jointNames(
      name = {
        caster_swivel.name,
        caster_roll.name,
        drive_left.name,
        drive_right.name,
        lift.name,
        head_pan.name,
        head_tilt.name,
        lidar_spin.name}),
    turningLimits(
      lower = {
        -Modelica.Constants.inf,
        -Modelica.Constants.inf,
        -Modelica.Constants.inf,
        -Modelica.Constants.inf,
        head_pan.limits.lower,
        head_tilt.limits.lower,
        -Modelica.Constants.inf},
      upper = {
        Modelica.Constants.inf,
        Modelica.Constants.inf,
        Modelica.Constants.inf,
        Modelica.Constants.inf,
        head_pan.limits.upper,
        head_tilt.limits.upper,
        Modelica.Constants.inf},
      velocity = {
        caster_swivel.limits.velocity,
        caster_roll.limits.velocity,
        drive_left.limits.velocity,
        drive_right.limits.velocity,
        head_pan.limits.velocity,
        head_tilt.limits.velocity,
        lidar_spin.limits.velocity},
      effort = {
        caster_swivel.limits.effort,
        caster_roll.limits.effort,
        drive_left.limits.effort,
        drive_right.limits.effort,
        head_pan.limits.effort,
        head_tilt.limits.effort,
        lidar_spin.limits.effort}),
    turningLosses(
      damping = {
        caster_swivel.dynamics.damping,
        caster_roll.dynamics.damping,
        drive_left.dynamics.damping,
        drive_right.dynamics.damping,
        head_pan.dynamics.damping,
        head_tilt.dynamics.damping,
        lidar_spin.dynamics.damping},
      friction = {
        caster_swivel.dynamics.friction,
        caster_roll.dynamics.friction,
        drive_left.dynamics.friction,
        drive_right.dynamics.friction,
        head_pan.dynamics.friction,
        head_tilt.dynamics.friction,
        lidar_spin.dynamics.friction},
      steepness = {
        caster_swivel.dynamics.steepness,
        caster_roll.dynamics.steepness,
        drive_left.dynamics.steepness,
        drive_right.dynamics.steepness,
        head_pan.dynamics.steepness,
        head_tilt.dynamics.steepness,
        lidar_spin.dynamics.steepness}),
    slidingLimits(
      lower = {
        lift.limits.lower},
      upper = {
        lift.limits.upper},
      velocity = {
        lift.limits.velocity},
      effort = {
        lift.limits.effort}),
    slidingLosses(
      damping = {
        lift.dynamics.damping},
      friction = {
        lift.dynamics.friction},
      steepness = {
        lift.dynamics.steepness}));

  constant Integer caster_swivelAxis = 1
    "Number of joint \"caster_swivel\" in rotationalAxis";

  constant Integer caster_rollAxis = 2
    "Number of joint \"caster_roll\" in rotationalAxis";

  constant Integer drive_leftAxis = 3
    "Number of joint \"drive_left\" in rotationalAxis";

  constant Integer drive_rightAxis = 4
    "Number of joint \"drive_right\" in rotationalAxis";

  constant Integer head_panAxis = 5
    "Number of joint \"head_pan\" in rotationalAxis";

  constant Integer head_tiltAxis = 6
    "Number of joint \"head_tilt\" in rotationalAxis";

  constant Integer lidar_spinAxis = 7
    "Number of joint \"lidar_spin\" in rotationalAxis";

  constant Integer liftAxis = 1
    "Number of joint \"lift\" in translationalAxis";

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
All numbers of robot WheeledRobot in one record, with the tables by which <code>UrdfSync.Robots.GenericRobot</code> reads how links and joints hang together. The tables refer to the numbers below them. Where the package has models of the links and joints, these read the records of their elements, and the numbers here are a copy: an edit here changes no such model.
</p>
</html>"));
end WheeledRobotParameters;
