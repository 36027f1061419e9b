within Zoo.Twig;

record TwigParameters "Numbers of robot Twig as a whole"
  extends UrdfSync.Records.Robot(
    name = "twig",
    connectionMatrix = [1, 2; 2, 3; 3, 4; 3, 5; 5, 6; 3, 7; 1, 8; 1, 9],
    moveableJoints = [2, 1; 3, 1; 4, 1; 6, 1; 7, 1; 8, 1],
    movingJoints = 6,
    turningJoints = 5,
    slidingJoints = 1,
    rotationalAxes = 2,
    translationalAxes = 1,
    jointTree = {{1, 1}, {2, 1}, {2, 2}, {2, 1}, {1, 1}, {1, 1}},
    firstJoints = {1, 2, 7, 7, 7, 7, 7},
    nextJoints = {5, 3, 4, 7, 6, 7},
    linkBodies = {1, 1, 2, 3, 4, 4, 5, 6, 7},
    turning = {1, 2, 4, 5, 6},
    sliding = {3},
    rotationalJoints = {1, 6},
    translationalJoints = {3},
    followers = {{5, 0}, {2, 3}, {4, 2}},
    jointAxes = {
      bend.axis,
      first.axis,
      grow.axis,
      second.axis,
      thorn.axis,
      turn.axis},
    jointPositions = {
      hold_0d1b23.origin.xyz,
      bend.origin.xyz,
      first.origin.xyz,
      grow.origin.xyz,
      tip.origin.xyz,
      second.origin.xyz,
      thorn.origin.xyz,
      turn.origin.xyz},
    jointAngles = {
      hold_0d1b23.origin.rpy,
      bend.origin.rpy,
      first.origin.rpy,
      grow.origin.rpy,
      tip.origin.rpy,
      second.origin.rpy,
      thorn.origin.rpy,
      turn.origin.rpy},
    followerMultipliers = {
      thorn.mimic.multiplier,
      first.mimic.multiplier,
      second.mimic.multiplier},
    followerAngles = {
      thorn.mimic.offset,
      first.mimic.offset,
      second.mimic.offset},
    followerLengths = {
      0,
      0,
      0},
    linkMasses = {
      stem.inertial.mass,
      jointTree_4989fb.inertial.mass,
      branch.inertial.mass,
      leaf1.inertial.mass,
      shoot.inertial.mass,
      bud.inertial.mass,
      leaf2.inertial.mass,
      spike.inertial.mass,
      vane.inertial.mass},
    linkCenters = {
      stem.inertial.origin.xyz,
      jointTree_4989fb.inertial.origin.xyz,
      branch.inertial.origin.xyz,
      leaf1.inertial.origin.xyz,
      shoot.inertial.origin.xyz,
      bud.inertial.origin.xyz,
      leaf2.inertial.origin.xyz,
      spike.inertial.origin.xyz,
      vane.inertial.origin.xyz},
    inertialAngles = {
      stem.inertial.origin.rpy,
      jointTree_4989fb.inertial.origin.rpy,
      branch.inertial.origin.rpy,
      leaf1.inertial.origin.rpy,
      shoot.inertial.origin.rpy,
      bud.inertial.origin.rpy,
      leaf2.inertial.origin.rpy,
      spike.inertial.origin.rpy,
      vane.inertial.origin.rpy},
    linkInertias = {
      {stem.inertial.inertia.ixx, stem.inertial.inertia.iyy, stem.inertial.inertia.izz,
       stem.inertial.inertia.ixy, stem.inertial.inertia.ixz, stem.inertial.inertia.iyz},
      {jointTree_4989fb.inertial.inertia.ixx, jointTree_4989fb.inertial.inertia.iyy, jointTree_4989fb.inertial.inertia.izz,
       jointTree_4989fb.inertial.inertia.ixy, jointTree_4989fb.inertial.inertia.ixz, jointTree_4989fb.inertial.inertia.iyz},
      {branch.inertial.inertia.ixx, branch.inertial.inertia.iyy, branch.inertial.inertia.izz,
       branch.inertial.inertia.ixy, branch.inertial.inertia.ixz, branch.inertial.inertia.iyz},
      {leaf1.inertial.inertia.ixx, leaf1.inertial.inertia.iyy, leaf1.inertial.inertia.izz,
       leaf1.inertial.inertia.ixy, leaf1.inertial.inertia.ixz, leaf1.inertial.inertia.iyz},
      {shoot.inertial.inertia.ixx, shoot.inertial.inertia.iyy, shoot.inertial.inertia.izz,
       shoot.inertial.inertia.ixy, shoot.inertial.inertia.ixz, shoot.inertial.inertia.iyz},
      {bud.inertial.inertia.ixx, bud.inertial.inertia.iyy, bud.inertial.inertia.izz,
       bud.inertial.inertia.ixy, bud.inertial.inertia.ixz, bud.inertial.inertia.iyz},
      {leaf2.inertial.inertia.ixx, leaf2.inertial.inertia.iyy, leaf2.inertial.inertia.izz,
       leaf2.inertial.inertia.ixy, leaf2.inertial.inertia.ixz, leaf2.inertial.inertia.iyz},
      {spike.inertial.inertia.ixx, spike.inertial.inertia.iyy, spike.inertial.inertia.izz,
       spike.inertial.inertia.ixy, spike.inertial.inertia.ixz, spike.inertial.inertia.iyz},
      {vane.inertial.inertia.ixx, vane.inertial.inertia.iyy, vane.inertial.inertia.izz,
       vane.inertial.inertia.ixy, vane.inertial.inertia.ixz, vane.inertial.inertia.iyz}},
    jointNames(
      name = {
        bend.name,
        first.name,
        grow.name,
        second.name,
        thorn.name,
        turn.name}),
    turningLimits(
      lower = {
        bend.limits.lower,
        first.limits.lower,
        -Modelica.Constants.inf,
        thorn.limits.lower,
        -Modelica.Constants.inf},
      upper = {
        bend.limits.upper,
        first.limits.upper,
        Modelica.Constants.inf,
        thorn.limits.upper,
        Modelica.Constants.inf},
      velocity = {
        bend.limits.velocity,
        first.limits.velocity,
        second.limits.velocity,
        thorn.limits.velocity,
        turn.limits.velocity},
      effort = {
        bend.limits.effort,
        first.limits.effort,
        second.limits.effort,
        thorn.limits.effort,
        turn.limits.effort}),
    turningLosses(
      damping = {
        bend.dynamics.damping,
        first.dynamics.damping,
        second.dynamics.damping,
        thorn.dynamics.damping,
        turn.dynamics.damping},
      friction = {
        bend.dynamics.friction,
        first.dynamics.friction,
        second.dynamics.friction,
        thorn.dynamics.friction,
        turn.dynamics.friction},
      steepness = {
        bend.dynamics.steepness,
        first.dynamics.steepness,
        second.dynamics.steepness,
        thorn.dynamics.steepness,
        turn.dynamics.steepness}),
    slidingLimits(
      lower = {
        grow.limits.lower},
      upper = {
        grow.limits.upper},
      velocity = {
        grow.limits.velocity},
      effort = {
        grow.limits.effort}),
    slidingLosses(
      damping = {
        grow.dynamics.damping},
      friction = {
        grow.dynamics.friction},
      steepness = {
        grow.dynamics.steepness}));

  constant Integer bendAxis = 1
    "Number of joint \"bend\" in rotationalAxis";

  constant Integer turnAxis = 2
    "Number of joint \"turn\" in rotationalAxis";

  constant Integer growAxis = 1
    "Number of joint \"grow\" in translationalAxis";

  UrdfSync.Records.Link stem(
    name = "stem",
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
    "Link 1: \"stem\"";

  UrdfSync.Records.Link jointTree_4989fb(
    name = "jointTree",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.5,
      inertia(
        ixx = 0.01,
        iyy = 0.01,
        izz = 0.01,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 2: \"jointTree\"";

  UrdfSync.Records.Link branch(
    name = "branch",
    inertial(
      origin(
        xyz = {0.1, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1.5,
      inertia(
        ixx = 0.002,
        iyy = 0.02,
        izz = 0.02,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 3: \"branch\"";

  UrdfSync.Records.Link leaf1(
    name = "leaf1",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.125,
      inertia(
        ixx = 1e-05,
        iyy = 1e-05,
        izz = 2e-05,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 4: \"leaf1\"";

  UrdfSync.Records.Link shoot(
    name = "shoot",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.25,
      inertia(
        ixx = 0.0001,
        iyy = 0.0002,
        izz = 0.0002,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 5: \"shoot\"";

  UrdfSync.Records.Link bud(
    name = "bud",
    hasInertial = false)
    "Link 6: \"bud\"";

  UrdfSync.Records.Link leaf2(
    name = "leaf2",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.125,
      inertia(
        ixx = 1e-05,
        iyy = 1e-05,
        izz = 2e-05,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 7: \"leaf2\"";

  UrdfSync.Records.Link spike(
    name = "spike",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.0625,
      inertia(
        ixx = 1e-05,
        iyy = 1e-05,
        izz = 1e-05,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 8: \"spike\"";

  UrdfSync.Records.Link vane(
    name = "vane",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.75,
      inertia(
        ixx = 0.001,
        iyy = 0.003,
        izz = 0.003,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 9: \"vane\"";

  UrdfSync.Records.FixedJoint hold_0d1b23(
    name = "hold",
    origin(
      xyz = {0, 0, 0.5},
      rpy = {0, 0, 0.25}))
    "Joint 1: \"hold\"";

  UrdfSync.Records.RevoluteJoint bend(
    name = "bend",
    origin(
      xyz = {0.1, 0, 0.2},
      rpy = {0.5, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -0.5,
      upper = 1.25,
      velocity = 2,
      effort = 20),
    dynamics(
      damping = 0.25,
      friction = 0.125))
    "Joint 2: \"bend\"";

  UrdfSync.Records.RevoluteJoint first(
    name = "first",
    origin(
      xyz = {0.05, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -3,
      upper = 3,
      velocity = 20,
      effort = 5),
    mimic(
      multiplier = 8,
      offset = 0))
    "Joint 3: \"first\"";

  UrdfSync.Records.PrismaticJoint grow(
    name = "grow",
    origin(
      xyz = {0.2, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = 0,
      upper = 0.15,
      velocity = 0.1,
      effort = 50))
    "Joint 4: \"grow\"";

  UrdfSync.Records.FixedJoint tip(
    name = "tip",
    origin(
      xyz = {0.05, 0, 0},
      rpy = {0, 0, 0}))
    "Joint 5: \"tip\"";

  UrdfSync.Records.ContinuousJoint second(
    name = "second",
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
      multiplier = -2,
      offset = 0.5))
    "Joint 6: \"second\"";

  UrdfSync.Records.RevoluteJoint thorn(
    name = "thorn",
    origin(
      xyz = {0, 0.1, 0.1},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 1,
      effort = 1),
    mimic(
      multiplier = 1,
      offset = 0.75))
    "Joint 7: \"thorn\"";

  UrdfSync.Records.ContinuousJoint turn(
    name = "turn",
    origin(
      xyz = {0, 0, 1},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf),
    dynamics(
      damping = 0.01,
      friction = 0))
    "Joint 8: \"turn\"";

  annotation (Documentation(info="<html>
<p>
All numbers of robot Twig in one record, with the tables by which <code>UrdfSync.Robots.GenericRobot</code> reads how links and joints hang together. The tables refer to the numbers below them. Where the package has models of the links and joints, these read the records of their elements, and the numbers here are a copy: an edit here changes no such model.
</p>
</html>"));
end TwigParameters;
