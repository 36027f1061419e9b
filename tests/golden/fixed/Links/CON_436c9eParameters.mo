within Zoo.Menagerie.Links;

record CON_436c9eParameters "Numbers of link \"CON\""
  extends UrdfSync.Records.Link(
    name = "CON",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1,
      inertia(
        ixx = 0.01,
        iyy = 0.01,
        izz = 0.02,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.15,
    length = 0.04,
    color = {128, 128, 140},
    opacity = 1)
    "Visual 1";

  UrdfSync.Records.Cylinder collision1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.15,
    length = 0.04,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;CON&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end CON_436c9eParameters;
