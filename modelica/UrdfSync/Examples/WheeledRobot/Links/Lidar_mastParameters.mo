within UrdfSync.Examples.WheeledRobot.Links;

record Lidar_mastParameters "Numbers of link \"lidar_mast\""
  extends UrdfSync.Records.Link(
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
        iyz = 0)));

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0, 0, 0.006},
      rpy = {0, 0, 0}),
    radius = 0.04,
    length = 0.012,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 1: \"foot\"";

  UrdfSync.Records.Cylinder visual2(
    origin(
      xyz = {0, 0, 0.066},
      rpy = {0, 0, 0}),
    radius = 0.018,
    length = 0.108,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"post\"";

  UrdfSync.Records.Cylinder visual3(
    origin(
      xyz = {0, 0, 0.134},
      rpy = {0, 0, 0}),
    radius = 0.038,
    length = 0.028,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"motor\"";

  UrdfSync.Records.Cylinder collision1(
    origin(
      xyz = {0, 0, 0.074},
      rpy = {0, 0, 0}),
    radius = 0.04,
    length = 0.148,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"mast\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;lidar_mast&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "16178f7f-a4a5", base = "cdc29932b390338b"));
end Lidar_mastParameters;
