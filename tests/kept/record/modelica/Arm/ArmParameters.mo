within Arm;

record ArmParameters "Numbers of robot Arm as a whole"
  extends UrdfSync.Records.Robot(
    name = "arm",
    connectionMatrix = [1, 2],
    moveableJoints = [1, 1],
    movingJoints = 1,
    turningJoints = 1,
    rotationalAxes = 1,
    jointTree = {{1, 1}},
    firstJoints = {1, 2},
    nextJoints = {2},
    linkBodies = {1, 2},
    turning = {1},
    rotationalJoints = {1},
    jointAxes = {
      elbow.axis},
    jointPositions = {
      elbow.origin.xyz},
    jointAngles = {
      elbow.origin.rpy},
    linkMasses = {
      base.inertial.mass,
      fore.inertial.mass},
    linkCenters = {
      base.inertial.origin.xyz,
      fore.inertial.origin.xyz},
    inertialAngles = {
      base.inertial.origin.rpy,
      fore.inertial.origin.rpy},
    linkInertias = {
      {base.inertial.inertia.ixx, base.inertial.inertia.iyy, base.inertial.inertia.izz,
       base.inertial.inertia.ixy, base.inertial.inertia.ixz, base.inertial.inertia.iyz},
      {fore.inertial.inertia.ixx, fore.inertial.inertia.iyy, fore.inertial.inertia.izz,
       fore.inertial.inertia.ixy, fore.inertial.inertia.ixz, fore.inertial.inertia.iyz}},
    jointNames(
      name = {
        elbow.name}),
    turningLimits(
      lower = {
        elbow.limits.lower},
      upper = {
        elbow.limits.upper},
      velocity = {
        elbow.limits.velocity},
      effort = {
        elbow.limits.effort}),
    turningLosses(
      damping = {
        elbow.dynamics.damping},
      friction = {
        elbow.dynamics.friction},
      steepness = {
        elbow.dynamics.steepness}));

  constant Integer elbowAxis = 1
    "Number of joint \"elbow\" in rotationalAxis";

  UrdfSync.Records.Link base(
    name = "base",
    hasInertial = false)
    "Link 1: \"base\"";

  UrdfSync.Records.Link fore(
    name = "fore",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 2.5,
      inertia(
        ixx = 1,
        iyy = 1,
        izz = 1,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 2: \"fore\"";

  UrdfSync.Records.RevoluteJoint elbow(
    name = "elbow",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -1,
      upper = 1,
      velocity = 2,
      effort = 5))
    "Joint 1: \"elbow\"";

  annotation (Documentation(info="<html>
<p>
All numbers of robot Arm in one record, with the tables by which <code>UrdfSync.Robots.GenericRobot</code> reads how links and joints hang together. The tables refer to the numbers below them. Where the package has models of the links and joints, these read the records of their elements, and the numbers here are a copy: an edit here changes no such model.
</p>
</html>"),
    __urdfsync(id = "18d63be1-d6f1", base = "ef88d71697f78bd9"));
end ArmParameters;
