within Rig;

record RigParameters "Numbers of robot Rig as a whole"
  extends UrdfSync.Records.Robot(
    name = "rig",
    standingHeight = 0.249,
    connectionMatrix = [1, 2; 1, 3; 1, 4; 1, 5; 5, 6; 5, 7; 7, 8; 8, 9; 9, 10; 10, 11; 7, 12],
    moveableJoints = [1, 1; 2, 1; 3, 1; 4, 1; 5, 1; 6, 1; 7, 1; 8, 1; 9, 1; 10, 1; 11, 1],
    movingJoints = 11,
    turningJoints = 8,
    slidingJoints = 3,
    rotationalAxes = 7,
    translationalAxes = 2,
    jointTree = {
      {1, 1}, {1, 1}, {1, 1}, {1, 1}, {5, 1}, {5, 2}, {7, 2}, {8, 1}, {9, 1}, {10, 1},
      {7, 2}},
    firstJoints = {
      1, 12, 12, 12, 5, 12, 7, 8, 9, 10,
      12, 12},
    nextJoints = {
      2, 3, 4, 12, 6, 12, 11, 12, 12, 12,
      12},
    linkBodies = {
      1, 2, 3, 4, 5, 6, 7, 8, 9, 10,
      11, 12},
    turning = {1, 2, 3, 4, 5, 8, 9, 10},
    sliding = {6, 7, 11},
    rotationalJoints = {1, 2, 3, 4, 8, 9, 10},
    translationalJoints = {6, 7},
    followers = {{5, 4}, {11, 6}},
    jointAxes = {
      caster1.axis,
      caster2.axis,
      caster3.axis,
      waist.axis,
      fan.axis,
      lift.axis,
      push.axis,
      tilt.axis,
      flex.axis,
      roll.axis,
      rack.axis},
    jointPositions = {
      caster1.origin.xyz,
      caster2.origin.xyz,
      caster3.origin.xyz,
      waist.origin.xyz,
      fan.origin.xyz,
      lift.origin.xyz,
      push.origin.xyz,
      tilt.origin.xyz,
      flex.origin.xyz,
      roll.origin.xyz,
      rack.origin.xyz},
    jointAngles = {
      caster1.origin.rpy,
      caster2.origin.rpy,
      caster3.origin.rpy,
      waist.origin.rpy,
      fan.origin.rpy,
      lift.origin.rpy,
      push.origin.rpy,
      tilt.origin.rpy,
      flex.origin.rpy,
      roll.origin.rpy,
      rack.origin.rpy},
    followerMultipliers = {
      fan.mimic.multiplier,
      rack.mimic.multiplier},
    followerAngles = {
      fan.mimic.offset,
      0},
    followerLengths = {
      0,
      rack.mimic.offset},
    linkMasses = {
      base.inertial.mass,
      wheel1.inertial.mass,
      wheel2.inertial.mass,
      wheel3.inertial.mass,
      trunk.inertial.mass,
      blade.inertial.mass,
      fork.inertial.mass,
      plate.inertial.mass,
      head.inertial.mass,
      palm.inertial.mass,
      tool.inertial.mass,
      tooth.inertial.mass},
    linkCenters = {
      base.inertial.origin.xyz,
      wheel1.inertial.origin.xyz,
      wheel2.inertial.origin.xyz,
      wheel3.inertial.origin.xyz,
      trunk.inertial.origin.xyz,
      blade.inertial.origin.xyz,
      fork.inertial.origin.xyz,
      plate.inertial.origin.xyz,
      head.inertial.origin.xyz,
      palm.inertial.origin.xyz,
      tool.inertial.origin.xyz,
      tooth.inertial.origin.xyz},
    inertialAngles = {
      base.inertial.origin.rpy,
      wheel1.inertial.origin.rpy,
      wheel2.inertial.origin.rpy,
      wheel3.inertial.origin.rpy,
      trunk.inertial.origin.rpy,
      blade.inertial.origin.rpy,
      fork.inertial.origin.rpy,
      plate.inertial.origin.rpy,
      head.inertial.origin.rpy,
      palm.inertial.origin.rpy,
      tool.inertial.origin.rpy,
      tooth.inertial.origin.rpy},
    linkInertias = {
      {base.inertial.inertia.ixx, base.inertial.inertia.iyy, base.inertial.inertia.izz,
       base.inertial.inertia.ixy, base.inertial.inertia.ixz, base.inertial.inertia.iyz},
      {wheel1.inertial.inertia.ixx, wheel1.inertial.inertia.iyy, wheel1.inertial.inertia.izz,
       wheel1.inertial.inertia.ixy, wheel1.inertial.inertia.ixz, wheel1.inertial.inertia.iyz},
      {wheel2.inertial.inertia.ixx, wheel2.inertial.inertia.iyy, wheel2.inertial.inertia.izz,
       wheel2.inertial.inertia.ixy, wheel2.inertial.inertia.ixz, wheel2.inertial.inertia.iyz},
      {wheel3.inertial.inertia.ixx, wheel3.inertial.inertia.iyy, wheel3.inertial.inertia.izz,
       wheel3.inertial.inertia.ixy, wheel3.inertial.inertia.ixz, wheel3.inertial.inertia.iyz},
      {trunk.inertial.inertia.ixx, trunk.inertial.inertia.iyy, trunk.inertial.inertia.izz,
       trunk.inertial.inertia.ixy, trunk.inertial.inertia.ixz, trunk.inertial.inertia.iyz},
      {blade.inertial.inertia.ixx, blade.inertial.inertia.iyy, blade.inertial.inertia.izz,
       blade.inertial.inertia.ixy, blade.inertial.inertia.ixz, blade.inertial.inertia.iyz},
      {fork.inertial.inertia.ixx, fork.inertial.inertia.iyy, fork.inertial.inertia.izz,
       fork.inertial.inertia.ixy, fork.inertial.inertia.ixz, fork.inertial.inertia.iyz},
      {plate.inertial.inertia.ixx, plate.inertial.inertia.iyy, plate.inertial.inertia.izz,
       plate.inertial.inertia.ixy, plate.inertial.inertia.ixz, plate.inertial.inertia.iyz},
      {head.inertial.inertia.ixx, head.inertial.inertia.iyy, head.inertial.inertia.izz,
       head.inertial.inertia.ixy, head.inertial.inertia.ixz, head.inertial.inertia.iyz},
      {palm.inertial.inertia.ixx, palm.inertial.inertia.iyy, palm.inertial.inertia.izz,
       palm.inertial.inertia.ixy, palm.inertial.inertia.ixz, palm.inertial.inertia.iyz},
      {tool.inertial.inertia.ixx, tool.inertial.inertia.iyy, tool.inertial.inertia.izz,
       tool.inertial.inertia.ixy, tool.inertial.inertia.ixz, tool.inertial.inertia.iyz},
      {tooth.inertial.inertia.ixx, tooth.inertial.inertia.iyy, tooth.inertial.inertia.izz,
       tooth.inertial.inertia.ixy, tooth.inertial.inertia.ixz, tooth.inertial.inertia.iyz}},
    jointNames(
      name = {
        caster1.name,
        caster2.name,
        caster3.name,
        waist.name,
        fan.name,
        lift.name,
        push.name,
        tilt.name,
        flex.name,
        roll.name,
        rack.name}),
    turningLimits(
      lower = {
        -Modelica.Constants.inf,
        -Modelica.Constants.inf,
        -Modelica.Constants.inf,
        -Modelica.Constants.inf,
        fan.limits.lower,
        tilt.limits.lower,
        flex.limits.lower,
        -Modelica.Constants.inf},
      upper = {
        Modelica.Constants.inf,
        Modelica.Constants.inf,
        Modelica.Constants.inf,
        Modelica.Constants.inf,
        fan.limits.upper,
        tilt.limits.upper,
        flex.limits.upper,
        Modelica.Constants.inf},
      velocity = {
        caster1.limits.velocity,
        caster2.limits.velocity,
        caster3.limits.velocity,
        waist.limits.velocity,
        fan.limits.velocity,
        tilt.limits.velocity,
        flex.limits.velocity,
        roll.limits.velocity},
      effort = {
        caster1.limits.effort,
        caster2.limits.effort,
        caster3.limits.effort,
        waist.limits.effort,
        fan.limits.effort,
        tilt.limits.effort,
        flex.limits.effort,
        roll.limits.effort},
      acceleration = {
        caster1.limits.acceleration,
        caster2.limits.acceleration,
        caster3.limits.acceleration,
        waist.limits.acceleration,
        fan.limits.acceleration,
        tilt.limits.acceleration,
        flex.limits.acceleration,
        roll.limits.acceleration},
      deceleration = {
        caster1.limits.deceleration,
        caster2.limits.deceleration,
        caster3.limits.deceleration,
        waist.limits.deceleration,
        fan.limits.deceleration,
        tilt.limits.deceleration,
        flex.limits.deceleration,
        roll.limits.deceleration}),
    turningLosses(
      damping = {
        caster1.dynamics.damping,
        caster2.dynamics.damping,
        caster3.dynamics.damping,
        waist.dynamics.damping,
        fan.dynamics.damping,
        tilt.dynamics.damping,
        flex.dynamics.damping,
        roll.dynamics.damping},
      friction = {
        caster1.dynamics.friction,
        caster2.dynamics.friction,
        caster3.dynamics.friction,
        waist.dynamics.friction,
        fan.dynamics.friction,
        tilt.dynamics.friction,
        flex.dynamics.friction,
        roll.dynamics.friction},
      steepness = {
        caster1.dynamics.steepness,
        caster2.dynamics.steepness,
        caster3.dynamics.steepness,
        waist.dynamics.steepness,
        fan.dynamics.steepness,
        tilt.dynamics.steepness,
        flex.dynamics.steepness,
        roll.dynamics.steepness}),
    slidingLimits(
      lower = {
        lift.limits.lower,
        push.limits.lower,
        rack.limits.lower},
      upper = {
        lift.limits.upper,
        push.limits.upper,
        rack.limits.upper},
      velocity = {
        lift.limits.velocity,
        push.limits.velocity,
        rack.limits.velocity},
      effort = {
        lift.limits.effort,
        push.limits.effort,
        rack.limits.effort},
      acceleration = {
        lift.limits.acceleration,
        push.limits.acceleration,
        rack.limits.acceleration},
      deceleration = {
        lift.limits.deceleration,
        push.limits.deceleration,
        rack.limits.deceleration}),
    slidingLosses(
      damping = {
        lift.dynamics.damping,
        push.dynamics.damping,
        rack.dynamics.damping},
      friction = {
        lift.dynamics.friction,
        push.dynamics.friction,
        rack.dynamics.friction},
      steepness = {
        lift.dynamics.steepness,
        push.dynamics.steepness,
        rack.dynamics.steepness}),
    turningInertias = {
      caster1.dynamics.armature + caster1.transmission.rotorInertia*caster1.transmission.reduction^2,
      caster2.dynamics.armature + caster2.transmission.rotorInertia*caster2.transmission.reduction^2,
      caster3.dynamics.armature + caster3.transmission.rotorInertia*caster3.transmission.reduction^2,
      waist.dynamics.armature + waist.transmission.rotorInertia*waist.transmission.reduction^2,
      fan.dynamics.armature + fan.transmission.rotorInertia*fan.transmission.reduction^2,
      tilt.dynamics.armature + tilt.transmission.rotorInertia*tilt.transmission.reduction^2,
      flex.dynamics.armature + flex.transmission.rotorInertia*flex.transmission.reduction^2,
      roll.dynamics.armature + roll.transmission.rotorInertia*roll.transmission.reduction^2},
    slidingMasses = {
      lift.dynamics.armature + lift.transmission.rotorInertia*lift.transmission.reduction^2,
      push.dynamics.armature + push.transmission.rotorInertia*push.transmission.reduction^2,
      rack.dynamics.armature + rack.transmission.rotorInertia*rack.transmission.reduction^2},
    drawnShapes = 8,
    visuals(
      links = {1, 1, 1, 1, 1, 1, 1, 1},
      kinds = {
        "box",
        "cylinder",
        "cylinder",
        "sphere",
        "sphere",
        "sphere",
        baseVisual5.uri,
        "sphere"},
      lengthAxes = {1, 3, 3, 3, 3, 3, 1, 1},
      positions = {
        baseVisual1.origin.xyz,
        baseVisual2.origin.xyz,
        baseVisual3.origin.xyz,
        baseVisual3.origin.xyz,
        baseVisual3.origin.xyz,
        baseVisual4.origin.xyz,
        baseVisual5.origin.xyz,
        baseVisual6.origin.xyz},
      angles = {
        baseVisual1.origin.rpy,
        baseVisual2.origin.rpy,
        baseVisual3.origin.rpy,
        baseVisual3.origin.rpy,
        baseVisual3.origin.rpy,
        baseVisual4.origin.rpy,
        baseVisual5.origin.rpy,
        baseVisual6.origin.rpy},
      starts = {
        -0.5*baseVisual1.size[1],
        -0.5*baseVisual2.length,
        -0.5*baseVisual3.length,
        -0.5*baseVisual3.length - baseVisual3.radius,
        0.5*baseVisual3.length - baseVisual3.radius,
        -baseVisual4.radius,
        0,
        -baseVisual6.radii[1]},
      sizes = {
        {baseVisual1.size[1], baseVisual1.size[2], baseVisual1.size[3]},
        {baseVisual2.length, 2*baseVisual2.radius, 2*baseVisual2.radius},
        {baseVisual3.length, 2*baseVisual3.radius, 2*baseVisual3.radius},
        {2*baseVisual3.radius, 2*baseVisual3.radius, 2*baseVisual3.radius},
        {2*baseVisual3.radius, 2*baseVisual3.radius, 2*baseVisual3.radius},
        {2*baseVisual4.radius, 2*baseVisual4.radius, 2*baseVisual4.radius},
        {1, 1, 1},
        {2*baseVisual6.radii[1], 2*baseVisual6.radii[2], 2*baseVisual6.radii[3]}},
      colors = {
        baseVisual1.color,
        baseVisual2.color,
        baseVisual3.color,
        baseVisual3.color,
        baseVisual3.color,
        baseVisual4.color,
        baseVisual5.color,
        baseVisual6.color}));

  constant Integer caster1Axis = 1
    "Number of joint \"caster1\" in rotationalAxis";

  constant Integer caster2Axis = 2
    "Number of joint \"caster2\" in rotationalAxis";

  constant Integer caster3Axis = 3
    "Number of joint \"caster3\" in rotationalAxis";

  constant Integer waistAxis = 4
    "Number of joint \"waist\" in rotationalAxis";

  constant Integer tiltAxis = 5
    "Number of joint \"tilt\" in rotationalAxis";

  constant Integer flexAxis = 6
    "Number of joint \"flex\" in rotationalAxis";

  constant Integer rollAxis = 7
    "Number of joint \"roll\" in rotationalAxis";

  constant Integer liftAxis = 1
    "Number of joint \"lift\" in translationalAxis";

  constant Integer pushAxis = 2
    "Number of joint \"push\" in translationalAxis";

  UrdfSync.Records.Link base(
    name = "base",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 9,
      inertia(
        ixx = 0.5,
        iyy = 0.5,
        izz = 0.5,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 1: \"base\"";

  UrdfSync.Records.Box baseVisual1(
    origin(
      xyz = {0, 0, 0.1},
      rpy = {0.1, 0.2, 0.3}),
    size = {0.3, 0.2, 0.1},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 1 of link \"base\"";

  UrdfSync.Records.Cylinder baseVisual2(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.1,
    length = 0.5,
    color = {180, 180, 180},
    opacity = 1)
    "Visual 2 of link \"base\"";

  UrdfSync.Records.Capsule baseVisual3(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.0625,
    length = 0.25,
    color = {180, 180, 180},
    opacity = 1)
    "Visual 3 of link \"base\"";

  UrdfSync.Records.Sphere baseVisual4(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.125,
    color = {255, 0, 0},
    opacity = 0.5)
    "Visual 4 of link \"base\"";

  UrdfSync.Records.Mesh baseVisual5(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://Rig/Resources/wedge_a859fdbe.obj",
    lower = {0, 0, 0},
    upper = {0.2, 0.1, 0.05},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 5 of link \"base\"";

  UrdfSync.Records.Ellipsoid baseVisual6(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radii = {0.25, 0.125, 0.0625},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 6 of link \"base\"";

  UrdfSync.Records.Link wheel1(
    name = "wheel1",
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
    "Link 2: \"wheel1\"";

  UrdfSync.Records.Link wheel2(
    name = "wheel2",
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
    "Link 3: \"wheel2\"";

  UrdfSync.Records.Link wheel3(
    name = "wheel3",
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
    "Link 4: \"wheel3\"";

  UrdfSync.Records.Link trunk(
    name = "trunk",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 3,
      inertia(
        ixx = 0.03,
        iyy = 0.03,
        izz = 0.03,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 5: \"trunk\"";

  UrdfSync.Records.Link blade(
    name = "blade",
    hasInertial = false)
    "Link 6: \"blade\"";

  UrdfSync.Records.Link fork(
    name = "fork",
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
    "Link 7: \"fork\"";

  UrdfSync.Records.Link plate(
    name = "plate",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1,
      inertia(
        ixx = 0.01,
        iyy = 0.01,
        izz = 0.01,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 8: \"plate\"";

  UrdfSync.Records.Link head(
    name = "head",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1,
      inertia(
        ixx = 0.01,
        iyy = 0.01,
        izz = 0.01,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 9: \"head\"";

  UrdfSync.Records.Link palm(
    name = "palm",
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
    "Link 10: \"palm\"";

  UrdfSync.Records.Link tool(
    name = "tool",
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
    "Link 11: \"tool\"";

  UrdfSync.Records.Link tooth(
    name = "tooth",
    hasInertial = false)
    "Link 12: \"tooth\"";

  UrdfSync.Records.ContinuousJoint caster1(
    name = "caster1",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf))
    "Joint 1: \"caster1\"";

  UrdfSync.Records.ContinuousJoint caster2(
    name = "caster2",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf))
    "Joint 2: \"caster2\"";

  UrdfSync.Records.ContinuousJoint caster3(
    name = "caster3",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf))
    "Joint 3: \"caster3\"";

  UrdfSync.Records.ContinuousJoint waist(
    name = "waist",
    origin(
      xyz = {0, 0, 0.5},
      rpy = {0.1, 0.2, 0.3}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = 2,
      effort = 90,
      acceleration = 5,
      deceleration = 7,
      jerk = 30),
    dynamics(
      damping = 0.5,
      friction = 1.25,
      armature = 0.01),
    transmission(
      reduction = 100,
      offset = 0.25,
      rotorInertia = 0.0002))
    "Joint 4: \"waist\"";

  UrdfSync.Records.RevoluteJoint fan(
    name = "fan",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 2,
      effort = 3),
    mimic(
      multiplier = 0.5,
      offset = 0))
    "Joint 5: \"fan\"";

  UrdfSync.Records.PrismaticJoint lift(
    name = "lift",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = 0,
      upper = 0.75,
      velocity = 0.5,
      effort = 500,
      acceleration = 2),
    dynamics(
      damping = 40,
      friction = 8,
      armature = 0.25),
    transmission(
      reduction = 400,
      offset = 0,
      rotorInertia = 1e-05))
    "Joint 6: \"lift\"";

  UrdfSync.Records.PrismaticJoint push(
    name = "push",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -0.25,
      upper = 0.25,
      velocity = 0.25,
      effort = 50),
    dynamics(
      damping = 10,
      friction = 4,
      armature = 0.5))
    "Joint 7: \"push\"";

  UrdfSync.Records.RevoluteJoint tilt(
    name = "tilt",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -1,
      upper = 1.5,
      velocity = 3,
      effort = 12,
      acceleration = 6),
    dynamics(
      damping = 0.25,
      friction = 0.5,
      armature = 0.002),
    transmission(
      reduction = 50,
      offset = 0,
      rotorInertia = 0.0001))
    "Joint 8: \"tilt\"";

  UrdfSync.Records.RevoluteJoint flex(
    name = "flex",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 4,
      effort = 30),
    transmission(
      reduction = 90,
      offset = 0,
      rotorInertia = 0.0002,
      otherReduction = 135))
    "Joint 9: \"flex\"";

  UrdfSync.Records.ContinuousJoint roll(
    name = "roll",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = 4,
      effort = 20),
    dynamics(
      damping = 0,
      friction = 0,
      armature = 0.001),
    transmission(
      reduction = 120,
      offset = 0,
      rotorInertia = 0.0001,
      otherReduction = -80))
    "Joint 10: \"roll\"";

  UrdfSync.Records.PrismaticJoint rack(
    name = "rack",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 1,
      effort = 5),
    mimic(
      multiplier = -1,
      offset = 0.125))
    "Joint 11: \"rack\"";

  annotation (Documentation(info="<html>
<p>
All numbers of robot Rig in one record, with the tables by which <code>UrdfSync.Robots.GenericRobot</code> reads how links and joints hang together. The tables refer to the numbers below them. Where the package has models of the links and joints, these read the records of their elements, and the numbers here are a copy: an edit here changes no such model.
</p>
</html>"));
end RigParameters;
