within UrdfSync.Examples.PlanarPlatform;

record PlanarPlatformParameters "Numbers of robot PlanarPlatform as a whole"
  extends UrdfSync.Records.Robot(
    name = "planar_platform",
    connectionMatrix = [1, 2; 2, 3],
    moveableJoints = [1, 1; 2, 1]);

  UrdfSync.Records.Link world_link(
    name = "world")
    "Link 1: \"world\"";

  UrdfSync.Records.Link platform(
    name = "platform",
    inertial(
      origin(
        xyz = {-0.0047, 0.0136, 0.0429},
        rpy = {0, 0, 0}),
      mass = 9.5,
      inertia(
        ixx = 0.0878,
        iyy = 0.08359,
        izz = 0.15454,
        ixy = 0.01154,
        ixz = 6e-05,
        iyz = -0.00324)))
    "Link 2: \"platform\"";

  UrdfSync.Records.Link boom(
    name = "boom",
    inertial(
      origin(
        xyz = {0.1615, 0.0039, 0.0259},
        rpy = {0, 0, 0}),
      mass = 2.4,
      inertia(
        ixx = 0.001249,
        iyy = 0.03211,
        izz = 0.032102,
        ixy = -0.001027,
        ixz = -0.00154,
        iyz = -8.6e-05)))
    "Link 3: \"boom\"";

  UrdfSync.Records.PlanarJoint glide(
    name = "glide",
    origin(
      xyz = {-0.1, 0.05, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    translation(
      damping = 0.4,
      friction = 0.02),
    rotation(
      damping = 0.4,
      friction = 0.02))
    "Joint 1: \"glide\"";

  UrdfSync.Records.RevoluteJoint boom_swing(
    name = "boom_swing",
    origin(
      xyz = {0.06, -0.04, 0.16},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -2.6,
      upper = 2.6,
      velocity = 3,
      effort = 6),
    dynamics(
      damping = 0.15,
      friction = 0.08))
    "Joint 2: \"boom_swing\"";

  annotation (Documentation(info="<html>
<p>
All numbers of robot PlanarPlatform in one record, for studies that need them all. <code>UrdfSync.Robots.GenericRobot</code> can't take it, since a joint is planar or floating. Where the package has models of the links and joints, these read the records of their elements, and the numbers here are a copy: an edit here changes no such model.
</p>
</html>"));
end PlanarPlatformParameters;
