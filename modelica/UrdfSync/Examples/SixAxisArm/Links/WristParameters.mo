within UrdfSync.Examples.SixAxisArm.Links;

record WristParameters "Numbers of link \"wrist\""
  extends UrdfSync.Records.Link(
    name = "wrist",
    inertial(
      origin(
        xyz = {0.0149, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1.3,
      inertia(
        ixx = 0.0007326,
        iyy = 0.001127,
        izz = 0.0011811,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.034,
    length = 0.066,
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"barrel\"";

  UrdfSync.Records.Cylinder visual2(
    origin(
      xyz = {0.034, 0, 0},
      rpy = {0, 1.5707963, 0}),
    radius = 0.03,
    length = 0.066,
    color = {230, 230, 222},
    opacity = 1)
    "Visual 2: \"nose\"";

  UrdfSync.Records.Cylinder collision1(
    origin(
      xyz = {0.0165, 0, 0},
      rpy = {0, 1.5707963, 0}),
    radius = 0.034,
    length = 0.101,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"nose\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;wrist&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "9ceaa769-a4a5", base = "aea38b26578e3aa4"));
end WristParameters;
