within UrdfSync.Examples.PlanarPlatform.Links;

record BoomParameters "Numbers of link \"boom\""
  extends UrdfSync.Records.Link(
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
        iyz = -8.6e-05)));

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0, 0, 0.02},
      rpy = {0, 0, 0}),
    radius = 0.034,
    length = 0.04,
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"hub\"";

  UrdfSync.Records.Box visual2(
    origin(
      xyz = {0.14, 0, 0.02},
      rpy = {0, 0, 0}),
    size = {0.28, 0.04, 0.024},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 2: \"beam\"";

  UrdfSync.Records.Cylinder visual3(
    origin(
      xyz = {0.27, 0.01, 0.035},
      rpy = {0, 0, 0}),
    radius = 0.035,
    length = 0.07,
    color = {89, 140, 51},
    opacity = 1)
    "Visual 3: \"weight\"";

  UrdfSync.Records.Box collision1(
    origin(
      xyz = {0.14, 0, 0.02},
      rpy = {0, 0, 0}),
    size = {0.33, 0.07, 0.04},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"beam\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;boom&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "5c87d25c-a4a5", base = "b80342efd7f9dcd2"));
end BoomParameters;
