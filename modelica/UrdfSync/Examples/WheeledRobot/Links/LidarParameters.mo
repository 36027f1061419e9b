within UrdfSync.Examples.WheeledRobot.Links;

record LidarParameters "Numbers of link \"lidar\""
  extends UrdfSync.Records.Link(
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
        iyz = 0)));

  UrdfSync.Records.Mesh visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.WheeledRobot/Resources/lidar_dome_e8ca69d5.obj",
    lower = {-0.036, -0.036, 0},
    upper = {0.036, 0.036, 0.043},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 1: \"dome\"";

  UrdfSync.Records.Box visual2(
    origin(
      xyz = {0.032, 0, 0.016},
      rpy = {0, 0, 0}),
    size = {0.012, 0.036, 0.014},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 2: \"window\"";

  UrdfSync.Records.Cylinder collision1(
    origin(
      xyz = {0, 0, 0.0215},
      rpy = {0, 0, 0}),
    radius = 0.038,
    length = 0.043,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"dome\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;lidar&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "254cf1d8-a4a5", base = "9988e4ff1e5a352b"));
end LidarParameters;
