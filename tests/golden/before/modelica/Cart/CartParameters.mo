within Cart;

record CartParameters "Numbers of robot Cart as a whole"
  extends UrdfSync.Records.Robot(
    name = "cart",
    standingHeight = 0.05,
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
      swing_joint.name}),
    jointAxes = {
      swing_joint.axis},
    jointLimits = {
      {swing_joint.limits.lower, swing_joint.limits.upper, swing_joint.limits.velocity, swing_joint.limits.effort}},
    jointLosses = {
      {swing_joint.dynamics.damping, swing_joint.dynamics.friction}},
    jointPositions = {
      swing_joint.origin.xyz},
    jointAngles = {
      swing_joint.origin.rpy},
    linkMasses = {
      base.inertial.mass,
      swingAxis.inertial.mass},
    linkCenters = {
      base.inertial.origin.xyz,
      swingAxis.inertial.origin.xyz},
    inertialAngles = {
      base.inertial.origin.rpy,
      swingAxis.inertial.origin.rpy},
    linkInertias = {
      {base.inertial.inertia.ixx, base.inertial.inertia.iyy, base.inertial.inertia.izz,
       base.inertial.inertia.ixy, base.inertial.inertia.ixz, base.inertial.inertia.iyz},
      {swingAxis.inertial.inertia.ixx, swingAxis.inertial.inertia.iyy, swingAxis.inertial.inertia.izz,
       swingAxis.inertial.inertia.ixy, swingAxis.inertial.inertia.ixz, swingAxis.inertial.inertia.iyz}});

  constant Integer swing_jointAxis = 1
    "Number of joint \"swing\" in rotationalAxis";

  UrdfSync.Records.Link base(
    name = "base")
    "Link 1: \"base\"";

  UrdfSync.Records.Link swingAxis(
    name = "swingAxis",
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
    "Link 2: \"swingAxis\"";

  UrdfSync.Records.RevoluteJoint swing_joint(
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
All numbers of robot Cart in one record, with the tables by which <code>UrdfSync.Robots.GenericRobot</code> reads how links and joints hang together. The tables refer to the numbers below them. A model that is generated per link and joint takes its numbers from its own record.
</p>
</html>"));
end CartParameters;
