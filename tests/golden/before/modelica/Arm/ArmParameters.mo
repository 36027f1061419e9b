within Arm;

record ArmParameters "Numbers of robot Arm as a whole"
  extends UrdfSync.Records.Robot(
    name = "arm",
    connectionMatrix = [1, 2],
    moveableJoints = [1, 1],
    movingJoints = 1,
    rotationalAxes = 1,
    jointTree = {{1, 1}},
    firstJoints = {1, 2},
    nextJoints = {2},
    linkBodies = {1, 2},
    rotationalJoints = {1},
    jointNames(name = {
      swing.name}),
    jointAxes = {
      swing.axis},
    jointLimits = {
      {swing.limits.lower, swing.limits.upper, swing.limits.velocity, swing.limits.effort}},
    jointLosses = {
      {swing.dynamics.damping, swing.dynamics.friction}},
    jointPositions = {
      swing.origin.xyz},
    jointAngles = {
      swing.origin.rpy},
    linkMasses = {
      base.inertial.mass,
      boom.inertial.mass},
    linkCenters = {
      base.inertial.origin.xyz,
      boom.inertial.origin.xyz},
    inertialAngles = {
      base.inertial.origin.rpy,
      boom.inertial.origin.rpy},
    linkInertias = {
      {base.inertial.inertia.ixx, base.inertial.inertia.iyy, base.inertial.inertia.izz,
       base.inertial.inertia.ixy, base.inertial.inertia.ixz, base.inertial.inertia.iyz},
      {boom.inertial.inertia.ixx, boom.inertial.inertia.iyy, boom.inertial.inertia.izz,
       boom.inertial.inertia.ixy, boom.inertial.inertia.ixz, boom.inertial.inertia.iyz}});

  constant Integer swingAxis = 1
    "Number of joint \"swing\" in rotationalAxis";

  UrdfSync.Records.Link base(
    name = "base")
    "Link 1: \"base\"";

  UrdfSync.Records.Link boom(
    name = "boom",
    inertial(
      origin(
        xyz = {0.3, 0, 0},
        rpy = {0, 0, 0}),
      mass = 2,
      inertia(
        ixx = 0.01,
        iyy = 0.1,
        izz = 0.1,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 2: \"boom\"";

  UrdfSync.Records.RevoluteJoint swing(
    name = "swing",
    origin(
      xyz = {0, 0, 0.1},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -1,
      upper = 2,
      velocity = 3,
      effort = 40),
    dynamics(
      damping = 0.1,
      friction = 0))
    "Joint 1: \"swing\"";

  annotation (Documentation(info="<html>
<p>
All numbers of robot Arm in one record, with the tables by which <code>UrdfSync.Robots.GenericRobot</code> reads how links and joints hang together. The tables refer to the numbers below them. A model that is generated per link and joint takes its numbers from its own record.
</p>
</html>"));
end ArmParameters;
