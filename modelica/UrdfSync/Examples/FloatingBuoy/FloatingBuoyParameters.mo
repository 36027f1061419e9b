within UrdfSync.Examples.FloatingBuoy;

record FloatingBuoyParameters "Numbers of robot FloatingBuoy as a whole"
  extends UrdfSync.Records.Robot(
    name = "floating_buoy",
    connectionMatrix = [1, 2; 2, 3],
    moveableJoints = [1, 1; 2, 1]);

  UrdfSync.Records.Link world_link(
    name = "world")
    "Link 1: \"world\"";

  UrdfSync.Records.Link buoy(
    name = "buoy",
    inertial(
      origin(
        xyz = {0.0044, 0.0031, -0.0359},
        rpy = {0, 0, 0}),
      mass = 62,
      inertia(
        ixx = 4.6257,
        iyy = 4.6544,
        izz = 4.4033,
        ixy = -0.0372,
        ixz = -0.0668,
        iyz = -0.0468)))
    "Link 2: \"buoy\"";

  UrdfSync.Records.Link clapper(
    name = "clapper",
    inertial(
      origin(
        xyz = {0, 0, -0.1877},
        rpy = {0, 0, 0}),
      mass = 1.3,
      inertia(
        ixx = 0.0026145,
        iyy = 0.0026145,
        izz = 0.0005684,
        ixy = 0,
        ixz = 0,
        iyz = 0)))
    "Link 3: \"clapper\"";

  UrdfSync.Records.FloatingJoint drift(
    name = "drift",
    origin(
      xyz = {0, 0, 1.2},
      rpy = {0, 0, 0.5}))
    "Joint 1: \"drift\"";

  UrdfSync.Records.ContinuousJoint clapper_swing(
    name = "clapper_swing",
    origin(
      xyz = {0, 0, 0.56},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf),
    dynamics(
      damping = 0.01,
      friction = 0.02))
    "Joint 2: \"clapper_swing\"";

  annotation (Documentation(info="<html>
<p>
All numbers of robot FloatingBuoy in one record, for studies that need them all. <code>UrdfSync.Robots.GenericRobot</code> can't take it, since a joint is planar or floating. Where the package has models of the links and joints, these read the records of their elements, and the numbers here are a copy: an edit here changes no such model.
</p>
</html>"));
end FloatingBuoyParameters;
