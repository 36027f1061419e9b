within UrdfSync.Examples.FourBar.Links;

record RockerParameters "Numbers of link \"rocker\""
  extends UrdfSync.Records.Link(
    name = "rocker",
    inertial(
      origin(
        xyz = {0.2, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.4,
      inertia(
        ixx = 4.333e-05,
        iyy = 0.005347,
        izz = 0.005363,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0.2, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.4, 0.03, 0.02},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"bar\"";

  UrdfSync.Records.Cylinder visual2(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.022,
    length = 0.024,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"hub\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;rocker&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "f2f7b4c9-a4a5", base = "c861cb1d5b5f41a8"));
end RockerParameters;
