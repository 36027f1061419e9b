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
        lift.dynamics.steepness}),
    drawnShapes = 43,
    visuals(
      links = {
        1, 1, 1, 1, 1, 1, 2, 2, 2, 2,
        3, 3, 4, 4, 4, 4, 4, 5, 5, 5,
        5, 5, 6, 6, 6, 7, 7, 8, 8, 8,
        8, 8, 8, 9, 9, 9, 9, 9, 11, 11,
        11, 12, 12},
      kinds = {
        base_linkVisual1.uri,
        "box",
        "box",
        "box",
        "box",
        "box",
        "cylinder",
        "box",
        "box",
        "box",
        "cylinder",
        "cylinder",
        wheel_leftVisual1.uri,
        "cylinder",
        "box",
        "box",
        "box",
        wheel_rightVisual1.uri,
        "cylinder",
        "box",
        "box",
        "box",
        "box",
        "box",
        "cylinder",
        "box",
        "cylinder",
        "cylinder",
        "box",
        "box",
        "box",
        "cylinder",
        "cylinder",
        headVisual1.uri,
        "box",
        "cylinder",
        "cylinder",
        "sphere",
        "cylinder",
        "cylinder",
        "cylinder",
        lidarVisual1.uri,
        "box"},
      lengthAxes = {
        1, 1, 1, 1, 1, 1, 3, 1, 1, 1,
        3, 3, 1, 3, 1, 1, 1, 1, 3, 1,
        1, 1, 1, 1, 3, 1, 3, 3, 1, 1,
        1, 3, 3, 1, 1, 3, 3, 3, 3, 3,
        3, 1, 1},
      positions = {
        base_linkVisual1.origin.xyz,
        base_linkVisual2.origin.xyz,
        base_linkVisual3.origin.xyz,
        base_linkVisual4.origin.xyz,
        base_linkVisual5.origin.xyz,
        base_linkVisual6.origin.xyz,
        caster_forkVisual1.origin.xyz,
        caster_forkVisual2.origin.xyz,
        caster_forkVisual3.origin.xyz,
        caster_forkVisual4.origin.xyz,
        caster_wheelVisual1.origin.xyz,
        caster_wheelVisual2.origin.xyz,
        wheel_leftVisual1.origin.xyz,
        wheel_leftVisual2.origin.xyz,
        wheel_leftVisual3.origin.xyz,
        wheel_leftVisual4.origin.xyz,
        wheel_leftVisual5.origin.xyz,
        wheel_rightVisual1.origin.xyz,
        wheel_rightVisual2.origin.xyz,
        wheel_rightVisual3.origin.xyz,
        wheel_rightVisual4.origin.xyz,
        wheel_rightVisual5.origin.xyz,
        column_guideVisual1.origin.xyz,
        column_guideVisual2.origin.xyz,
        column_guideVisual3.origin.xyz,
        columnVisual1.origin.xyz,
        columnVisual2.origin.xyz,
        neckVisual1.origin.xyz,
        neckVisual2.origin.xyz,
        neckVisual3.origin.xyz,
        neckVisual4.origin.xyz,
        neckVisual5.origin.xyz,
        neckVisual6.origin.xyz,
        headVisual1.origin.xyz,
        headVisual2.origin.xyz,
        headVisual3.origin.xyz,
        headVisual4.origin.xyz,
        headVisual5.origin.xyz,
        lidar_mastVisual1.origin.xyz,
        lidar_mastVisual2.origin.xyz,
        lidar_mastVisual3.origin.xyz,
        lidarVisual1.origin.xyz,
        lidarVisual2.origin.xyz},
      angles = {
        base_linkVisual1.origin.rpy,
        base_linkVisual2.origin.rpy,
        base_linkVisual3.origin.rpy,
        base_linkVisual4.origin.rpy,
        base_linkVisual5.origin.rpy,
        base_linkVisual6.origin.rpy,
        caster_forkVisual1.origin.rpy,
        caster_forkVisual2.origin.rpy,
        caster_forkVisual3.origin.rpy,
        caster_forkVisual4.origin.rpy,
        caster_wheelVisual1.origin.rpy,
        caster_wheelVisual2.origin.rpy,
        wheel_leftVisual1.origin.rpy,
        wheel_leftVisual2.origin.rpy,
        wheel_leftVisual3.origin.rpy,
        wheel_leftVisual4.origin.rpy,
        wheel_leftVisual5.origin.rpy,
        wheel_rightVisual1.origin.rpy,
        wheel_rightVisual2.origin.rpy,
        wheel_rightVisual3.origin.rpy,
        wheel_rightVisual4.origin.rpy,
        wheel_rightVisual5.origin.rpy,
        column_guideVisual1.origin.rpy,
        column_guideVisual2.origin.rpy,
        column_guideVisual3.origin.rpy,
        columnVisual1.origin.rpy,
        columnVisual2.origin.rpy,
        neckVisual1.origin.rpy,
        neckVisual2.origin.rpy,
        neckVisual3.origin.rpy,
        neckVisual4.origin.rpy,
        neckVisual5.origin.rpy,
        neckVisual6.origin.rpy,
        headVisual1.origin.rpy,
        headVisual2.origin.rpy,
        headVisual3.origin.rpy,
        headVisual4.origin.rpy,
        headVisual5.origin.rpy,
        lidar_mastVisual1.origin.rpy,
        lidar_mastVisual2.origin.rpy,
        lidar_mastVisual3.origin.rpy,
        lidarVisual1.origin.rpy,
        lidarVisual2.origin.rpy},
      starts = {
        0,
        -0.5*base_linkVisual2.size[1],
        -0.5*base_linkVisual3.size[1],
        -0.5*base_linkVisual4.size[1],
        -0.5*base_linkVisual5.size[1],
        -0.5*base_linkVisual6.size[1],
        -0.5*caster_forkVisual1.length,
        -0.5*caster_forkVisual2.size[1],
        -0.5*caster_forkVisual3.size[1],
        -0.5*caster_forkVisual4.size[1],
        -0.5*caster_wheelVisual1.length,
        -0.5*caster_wheelVisual2.length,
        0,
        -0.5*wheel_leftVisual2.length,
        -0.5*wheel_leftVisual3.size[1],
        -0.5*wheel_leftVisual4.size[1],
        -0.5*wheel_leftVisual5.size[1],
        0,
        -0.5*wheel_rightVisual2.length,
        -0.5*wheel_rightVisual3.size[1],
        -0.5*wheel_rightVisual4.size[1],
        -0.5*wheel_rightVisual5.size[1],
        -0.5*column_guideVisual1.size[1],
        -0.5*column_guideVisual2.size[1],
        -0.5*column_guideVisual3.length,
        -0.5*columnVisual1.size[1],
        -0.5*columnVisual2.length,
        -0.5*neckVisual1.length,
        -0.5*neckVisual2.size[1],
        -0.5*neckVisual3.size[1],
        -0.5*neckVisual4.size[1],
        -0.5*neckVisual5.length,
        -0.5*neckVisual6.length,
        0,
        -0.5*headVisual2.size[1],
        -0.5*headVisual3.length,
        -0.5*headVisual4.length,
        -headVisual5.radius,
        -0.5*lidar_mastVisual1.length,
        -0.5*lidar_mastVisual2.length,
        -0.5*lidar_mastVisual3.length,
        0,
        -0.5*lidarVisual2.size[1]},
      sizes = {
        {1, 1, 1},
        {base_linkVisual2.size[1], base_linkVisual2.size[2], base_linkVisual2.size[3]},
        {base_linkVisual3.size[1], base_linkVisual3.size[2], base_linkVisual3.size[3]},
        {base_linkVisual4.size[1], base_linkVisual4.size[2], base_linkVisual4.size[3]},
        {base_linkVisual5.size[1], base_linkVisual5.size[2], base_linkVisual5.size[3]},
        {base_linkVisual6.size[1], base_linkVisual6.size[2], base_linkVisual6.size[3]},
        {caster_forkVisual1.length, 2*caster_forkVisual1.radius, 2*caster_forkVisual1.radius},
        {caster_forkVisual2.size[1], caster_forkVisual2.size[2], caster_forkVisual2.size[3]},
        {caster_forkVisual3.size[1], caster_forkVisual3.size[2], caster_forkVisual3.size[3]},
        {caster_forkVisual4.size[1], caster_forkVisual4.size[2], caster_forkVisual4.size[3]},
        {caster_wheelVisual1.length, 2*caster_wheelVisual1.radius, 2*caster_wheelVisual1.radius},
        {caster_wheelVisual2.length, 2*caster_wheelVisual2.radius, 2*caster_wheelVisual2.radius},
        {1, 1, 1},
        {wheel_leftVisual2.length, 2*wheel_leftVisual2.radius, 2*wheel_leftVisual2.radius},
        {wheel_leftVisual3.size[1], wheel_leftVisual3.size[2], wheel_leftVisual3.size[3]},
        {wheel_leftVisual4.size[1], wheel_leftVisual4.size[2], wheel_leftVisual4.size[3]},
        {wheel_leftVisual5.size[1], wheel_leftVisual5.size[2], wheel_leftVisual5.size[3]},
        {1, 1, 1},
        {wheel_rightVisual2.length, 2*wheel_rightVisual2.radius, 2*wheel_rightVisual2.radius},
        {wheel_rightVisual3.size[1], wheel_rightVisual3.size[2], wheel_rightVisual3.size[3]},
        {wheel_rightVisual4.size[1], wheel_rightVisual4.size[2], wheel_rightVisual4.size[3]},
        {wheel_rightVisual5.size[1], wheel_rightVisual5.size[2], wheel_rightVisual5.size[3]},
        {column_guideVisual1.size[1], column_guideVisual1.size[2], column_guideVisual1.size[3]},
        {column_guideVisual2.size[1], column_guideVisual2.size[2], column_guideVisual2.size[3]},
        {column_guideVisual3.length, 2*column_guideVisual3.radius, 2*column_guideVisual3.radius},
        {columnVisual1.size[1], columnVisual1.size[2], columnVisual1.size[3]},
        {columnVisual2.length, 2*columnVisual2.radius, 2*columnVisual2.radius},
        {neckVisual1.length, 2*neckVisual1.radius, 2*neckVisual1.radius},
        {neckVisual2.size[1], neckVisual2.size[2], neckVisual2.size[3]},
        {neckVisual3.size[1], neckVisual3.size[2], neckVisual3.size[3]},
        {neckVisual4.size[1], neckVisual4.size[2], neckVisual4.size[3]},
        {neckVisual5.length, 2*neckVisual5.radius, 2*neckVisual5.radius},
        {neckVisual6.length, 2*neckVisual6.radius, 2*neckVisual6.radius},
        {1, 1, 1},
        {headVisual2.size[1], headVisual2.size[2], headVisual2.size[3]},
        {headVisual3.length, 2*headVisual3.radius, 2*headVisual3.radius},
        {headVisual4.length, 2*headVisual4.radius, 2*headVisual4.radius},
        {2*headVisual5.radius, 2*headVisual5.radius, 2*headVisual5.radius},
        {lidar_mastVisual1.length, 2*lidar_mastVisual1.radius, 2*lidar_mastVisual1.radius},
        {lidar_mastVisual2.length, 2*lidar_mastVisual2.radius, 2*lidar_mastVisual2.radius},
        {lidar_mastVisual3.length, 2*lidar_mastVisual3.radius, 2*lidar_mastVisual3.radius},
        {1, 1, 1},
        {lidarVisual2.size[1], lidarVisual2.size[2], lidarVisual2.size[3]}},
      colors = {
        base_linkVisual1.color,
        base_linkVisual2.color,
        base_linkVisual3.color,
        base_linkVisual4.color,
        base_linkVisual5.color,
        base_linkVisual6.color,
        caster_forkVisual1.color,
        caster_forkVisual2.color,
        caster_forkVisual3.color,
        caster_forkVisual4.color,
        caster_wheelVisual1.color,
        caster_wheelVisual2.color,
        wheel_leftVisual1.color,
        wheel_leftVisual2.color,
        wheel_leftVisual3.color,
        wheel_leftVisual4.color,
        wheel_leftVisual5.color,
        wheel_rightVisual1.color,
        wheel_rightVisual2.color,
        wheel_rightVisual3.color,
        wheel_rightVisual4.color,
        wheel_rightVisual5.color,
        column_guideVisual1.color,
        column_guideVisual2.color,
        column_guideVisual3.color,
        columnVisual1.color,
        columnVisual2.color,
        neckVisual1.color,
        neckVisual2.color,
        neckVisual3.color,
        neckVisual4.color,
        neckVisual5.color,
        neckVisual6.color,
        headVisual1.color,
        headVisual2.color,
        headVisual3.color,
        headVisual4.color,
        headVisual5.color,
        lidar_mastVisual1.color,
        lidar_mastVisual2.color,
        lidar_mastVisual3.color,
        lidarVisual1.color,
        lidarVisual2.color}));

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

  UrdfSync.Records.Mesh base_linkVisual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.WheeledRobot/Resources/chassis_044f37ec.stl",
    lower = {-0.33, -0.165, 0},
    upper = {0.19, 0.165, 0.11},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"body\" of link \"base_link\"";

  UrdfSync.Records.Box base_linkVisual2(
    origin(
      xyz = {-0.01, 0, -0.0275},
      rpy = {0, 0, 0}),
    size = {0.3, 0.29, 0.055},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"battery_and_motors\" of link \"base_link\"";

  UrdfSync.Records.Box base_linkVisual3(
    origin(
      xyz = {-0.07, 0, 0.114},
      rpy = {0, 0, 0}),
    size = {0.42, 0.24, 0.008},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"deck\" of link \"base_link\"";

  UrdfSync.Records.Box base_linkVisual4(
    origin(
      xyz = {0.19, 0, 0.03},
      rpy = {0, 0, 0}),
    size = {0.024, 0.2, 0.036},
    color = {26, 26, 26},
    opacity = 1)
    "Visual 4: \"bumper\" of link \"base_link\"";

  UrdfSync.Records.Box base_linkVisual5(
    origin(
      xyz = {-0.07, 0.165, 0.086},
      rpy = {0, 0, 0}),
    size = {0.34, 0.004, 0.012},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 5: \"stripe_left\" of link \"base_link\"";

  UrdfSync.Records.Box base_linkVisual6(
    origin(
      xyz = {-0.07, -0.165, 0.086},
      rpy = {0, 0, 0}),
    size = {0.34, 0.004, 0.012},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 6: \"stripe_right\" of link \"base_link\"";

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

  UrdfSync.Records.Cylinder caster_forkVisual1(
    origin(
      xyz = {0, 0, -0.006},
      rpy = {0, 0, 0}),
    radius = 0.028,
    length = 0.012,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 1: \"bearing\" of link \"caster_fork\"";

  UrdfSync.Records.Box caster_forkVisual2(
    origin(
      xyz = {-0.006, 0, -0.0145},
      rpy = {0, 0, 0}),
    size = {0.044, 0.04, 0.005},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"crown\" of link \"caster_fork\"";

  UrdfSync.Records.Box caster_forkVisual3(
    origin(
      xyz = {-0.02, 0.0175, -0.0415},
      rpy = {0, 0.45, 0}),
    size = {0.026, 0.004, 0.062},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 3: \"cheek_left\" of link \"caster_fork\"";

  UrdfSync.Records.Box caster_forkVisual4(
    origin(
      xyz = {-0.02, -0.0175, -0.0415},
      rpy = {0, 0.45, 0}),
    size = {0.026, 0.004, 0.062},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 4: \"cheek_right\" of link \"caster_fork\"";

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

  UrdfSync.Records.Cylinder caster_wheelVisual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.04,
    length = 0.026,
    color = {26, 26, 26},
    opacity = 1)
    "Visual 1: \"tread\" of link \"caster_wheel\"";

  UrdfSync.Records.Cylinder caster_wheelVisual2(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.006,
    length = 0.044,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"axle\" of link \"caster_wheel\"";

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

  UrdfSync.Records.Mesh wheel_leftVisual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.WheeledRobot/Resources/tyre_a7d9190a.obj",
    lower = {-0.1, -0.02, -0.1},
    upper = {0.1, 0.02, 0.1},
    color = {26, 26, 26},
    opacity = 1)
    "Visual 1: \"tyre\" of link \"wheel_left\"";

  UrdfSync.Records.Cylinder wheel_leftVisual2(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.07,
    length = 0.044,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"rim\" of link \"wheel_left\"";

  UrdfSync.Records.Box wheel_leftVisual3(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.13, 0.048, 0.014},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 3: \"spoke_1\" of link \"wheel_left\"";

  UrdfSync.Records.Box wheel_leftVisual4(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 1.0472, 0}),
    size = {0.13, 0.048, 0.014},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 4: \"spoke_2\" of link \"wheel_left\"";

  UrdfSync.Records.Box wheel_leftVisual5(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 2.0944, 0}),
    size = {0.13, 0.048, 0.014},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 5: \"spoke_3\" of link \"wheel_left\"";

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

  UrdfSync.Records.Mesh wheel_rightVisual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.WheeledRobot/Resources/tyre_a7d9190a.obj",
    lower = {-0.1, -0.02, -0.1},
    upper = {0.1, 0.02, 0.1},
    color = {26, 26, 26},
    opacity = 1)
    "Visual 1: \"tyre\" of link \"wheel_right\"";

  UrdfSync.Records.Cylinder wheel_rightVisual2(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.07,
    length = 0.044,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"rim\" of link \"wheel_right\"";

  UrdfSync.Records.Box wheel_rightVisual3(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.13, 0.048, 0.014},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 3: \"spoke_1\" of link \"wheel_right\"";

  UrdfSync.Records.Box wheel_rightVisual4(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 1.0472, 0}),
    size = {0.13, 0.048, 0.014},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 4: \"spoke_2\" of link \"wheel_right\"";

  UrdfSync.Records.Box wheel_rightVisual5(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 2.0944, 0}),
    size = {0.13, 0.048, 0.014},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 5: \"spoke_3\" of link \"wheel_right\"";

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

  UrdfSync.Records.Box column_guideVisual1(
    origin(
      xyz = {0, 0, 0.01},
      rpy = {0, 0, 0}),
    size = {0.14, 0.13, 0.02},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 1: \"foot\" of link \"column_guide\"";

  UrdfSync.Records.Box column_guideVisual2(
    origin(
      xyz = {0, 0, 0.225},
      rpy = {0, 0, 0}),
    size = {0.09, 0.08, 0.41},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 2: \"profile\" of link \"column_guide\"";

  UrdfSync.Records.Cylinder column_guideVisual3(
    origin(
      xyz = {-0.067, 0, 0.08},
      rpy = {0, 0, 0}),
    radius = 0.024,
    length = 0.12,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"lift_motor\" of link \"column_guide\"";

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

  UrdfSync.Records.Box columnVisual1(
    origin(
      xyz = {0, 0, -0.215},
      rpy = {0, 0, 0}),
    size = {0.066, 0.056, 0.41},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 1: \"profile\" of link \"column\"";

  UrdfSync.Records.Cylinder columnVisual2(
    origin(
      xyz = {0, 0, -0.005},
      rpy = {0, 0, 0}),
    radius = 0.045,
    length = 0.01,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"top_plate\" of link \"column\"";

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

  UrdfSync.Records.Cylinder neckVisual1(
    origin(
      xyz = {0, 0, 0.013},
      rpy = {0, 0, 0}),
    radius = 0.04,
    length = 0.026,
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"turntable\" of link \"neck\"";

  UrdfSync.Records.Box neckVisual2(
    origin(
      xyz = {0, 0, 0.031},
      rpy = {0, 0, 0}),
    size = {0.044, 0.212, 0.01},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"bridge\" of link \"neck\"";

  UrdfSync.Records.Box neckVisual3(
    origin(
      xyz = {0, 0.1, 0.07},
      rpy = {0, 0, 0}),
    size = {0.044, 0.012, 0.068},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"cheek_left\" of link \"neck\"";

  UrdfSync.Records.Box neckVisual4(
    origin(
      xyz = {0, -0.1, 0.07},
      rpy = {0, 0, 0}),
    size = {0.044, 0.012, 0.068},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 4: \"cheek_right\" of link \"neck\"";

  UrdfSync.Records.Cylinder neckVisual5(
    origin(
      xyz = {0, 0.103, 0.1},
      rpy = {1.5707963, 0, 0}),
    radius = 0.022,
    length = 0.018,
    color = {242, 140, 13},
    opacity = 1)
    "Visual 5: \"cap_left\" of link \"neck\"";

  UrdfSync.Records.Cylinder neckVisual6(
    origin(
      xyz = {0, -0.103, 0.1},
      rpy = {1.5707963, 0, 0}),
    radius = 0.022,
    length = 0.018,
    color = {242, 140, 13},
    opacity = 1)
    "Visual 6: \"cap_right\" of link \"neck\"";

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

  UrdfSync.Records.Mesh headVisual1(
    origin(
      xyz = {0.01, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.WheeledRobot/Resources/head_shell_abd072b6.stl",
    lower = {-0.05000000074505806, -0.08500000089406967, -0.03500000014901161},
    upper = {0.04500000178813934, 0.08500000089406967, 0.044999998062849045},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"shell\" of link \"head\"";

  UrdfSync.Records.Box headVisual2(
    origin(
      xyz = {0.052, 0, 0.005},
      rpy = {0, 0, 0}),
    size = {0.012, 0.13, 0.05},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"face\" of link \"head\"";

  UrdfSync.Records.Cylinder headVisual3(
    origin(
      xyz = {0.062, 0.042, 0.005},
      rpy = {0, 1.5707963, 0}),
    radius = 0.017,
    length = 0.016,
    color = {13, 26, 41},
    opacity = 0.8)
    "Visual 3: \"lens_left\" of link \"head\"";

  UrdfSync.Records.Cylinder headVisual4(
    origin(
      xyz = {0.062, -0.042, 0.005},
      rpy = {0, 1.5707963, 0}),
    radius = 0.017,
    length = 0.016,
    color = {13, 26, 41},
    opacity = 0.8)
    "Visual 4: \"lens_right\" of link \"head\"";

  UrdfSync.Records.Sphere headVisual5(
    origin(
      xyz = {0, 0, 0.047},
      rpy = {0, 0, 0}),
    radius = 0.01,
    color = {242, 140, 13},
    opacity = 1)
    "Visual 5: \"status_light\" of link \"head\"";

  UrdfSync.Records.Link camera_optical_frame(
    name = "camera_optical_frame",
    hasInertial = false)
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

  UrdfSync.Records.Cylinder lidar_mastVisual1(
    origin(
      xyz = {0, 0, 0.006},
      rpy = {0, 0, 0}),
    radius = 0.04,
    length = 0.012,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 1: \"foot\" of link \"lidar_mast\"";

  UrdfSync.Records.Cylinder lidar_mastVisual2(
    origin(
      xyz = {0, 0, 0.066},
      rpy = {0, 0, 0}),
    radius = 0.018,
    length = 0.108,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"post\" of link \"lidar_mast\"";

  UrdfSync.Records.Cylinder lidar_mastVisual3(
    origin(
      xyz = {0, 0, 0.134},
      rpy = {0, 0, 0}),
    radius = 0.038,
    length = 0.028,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"motor\" of link \"lidar_mast\"";

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

  UrdfSync.Records.Mesh lidarVisual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.WheeledRobot/Resources/lidar_dome_e8ca69d5.obj",
    lower = {-0.036, -0.036, 0},
    upper = {0.036, 0.036, 0.043},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 1: \"dome\" of link \"lidar\"";

  UrdfSync.Records.Box lidarVisual2(
    origin(
      xyz = {0.032, 0, 0.016},
      rpy = {0, 0, 0}),
    size = {0.012, 0.036, 0.014},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 2: \"window\" of link \"lidar\"";

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
      friction = 0.25),
    transmission(
      reduction = 24,
      offset = 0))
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
      friction = 0.25),
    transmission(
      reduction = 24,
      offset = 0))
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
</html>"),
    __urdfsync(id = "18d63be1-d6f1", base = "149edf286ec41068"));
end WheeledRobotParameters;
