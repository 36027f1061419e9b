within UrdfSync.Examples.FloatingBuoy.Links;

record ClapperParameters "Numbers of link \"clapper\""
  extends UrdfSync.Records.Link(
    name = "clapper",
    inertial(
      origin(
        xyz = {0, 0, -0.1877},
        rpy = {0, 0, 0}),
      mass = 1.3,
      inertia(
        ixx = 0.0026145,
        iyy = 0.0026145,
        izz = 0.0005684,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0, 0, -0.09},
      rpy = {0, 0, 0}),
    radius = 0.006,
    length = 0.2,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 1: \"rod\"";

  UrdfSync.Records.Sphere visual2(
    origin(
      xyz = {0, 0, -0.2},
      rpy = {0, 0, 0}),
    radius = 0.035,
    color = {178, 128, 51},
    opacity = 1)
    "Visual 2: \"ball\"";

  UrdfSync.Records.Sphere collision1(
    origin(
      xyz = {0, 0, -0.2},
      rpy = {0, 0, 0}),
    radius = 0.035,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"ball\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;clapper&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "e43efffb-a4a5", base = "44d260e1b0c449f4"));
end ClapperParameters;
