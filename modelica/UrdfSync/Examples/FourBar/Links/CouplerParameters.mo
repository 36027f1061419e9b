within UrdfSync.Examples.FourBar.Links;

record CouplerParameters "Numbers of link \"coupler\""
  extends UrdfSync.Records.Link(
    name = "coupler",
    inertial(
      origin(
        xyz = {0.3, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.6,
      inertia(
        ixx = 6.5e-05,
        iyy = 0.01802,
        izz = 0.01804,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0.3, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.6, 0.03, 0.02},
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
    "Visual 2: \"crank_pin\"";

  UrdfSync.Records.Cylinder visual3(
    origin(
      xyz = {0.6, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.022,
    length = 0.024,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 3: \"rocker_pin\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;coupler&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "bb730311-a4a5", base = "f8741d1351e153aa"));
end CouplerParameters;
