within UrdfSync.Examples.SixAxisArm.Links;

record Mounting_flangeParameters "Numbers of link \"mounting_flange\""
  extends UrdfSync.Records.Link(
    name = "mounting_flange",
    inertial(
      origin(
        xyz = {0.006, 0, 8e-05},
        rpy = {0, 0, 0}),
      mass = 0.22,
      inertia(
        ixx = 0.00010943,
        iyy = 5.763e-05,
        izz = 5.707e-05,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0.006, 0, 0},
      rpy = {0, 1.5707963, 0}),
    radius = 0.0315,
    length = 0.012,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 1: \"plate\"";

  UrdfSync.Records.Box visual2(
    origin(
      xyz = {0.006, 0, 0.0315},
      rpy = {0, 0, 0}),
    size = {0.008, 0.004, 0.003},
    color = {0, 120, 153},
    opacity = 1)
    "Visual 2: \"zero_mark\"";

  UrdfSync.Records.Cylinder collision1(
    origin(
      xyz = {0.006, 0, 0},
      rpy = {0, 1.5707963, 0}),
    radius = 0.0315,
    length = 0.012,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"plate\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;mounting_flange&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "3c295cef-a4a5", base = "e2379cefd81977d6"));
end Mounting_flangeParameters;
