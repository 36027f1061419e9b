within UrdfSync.Examples.FourBar.Links;

record CrankParameters "Numbers of link \"crank\""
  extends UrdfSync.Records.Link(
    name = "crank",
    inertial(
      origin(
        xyz = {0.1, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.3,
      inertia(
        ixx = 3.25e-05,
        iyy = 0.00101,
        izz = 0.001023,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0.1, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.2, 0.03, 0.02},
    color = {89, 140, 51},
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
Numbers of link &quot;crank&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "d8850225-a4a5", base = "6d44c38511e3b35e"));
end CrankParameters;
