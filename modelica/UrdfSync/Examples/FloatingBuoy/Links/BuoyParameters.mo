within UrdfSync.Examples.FloatingBuoy.Links;

record BuoyParameters "Numbers of link \"buoy\""
  extends UrdfSync.Records.Link(
    name = "buoy",
    inertial(
      origin(
        xyz = {0.0044, 0.0031, -0.0359},
        rpy = {0, 0, 0}),
      mass = 62,
      inertia(
        ixx = 4.6257,
        iyy = 4.6544,
        izz = 4.4033,
        ixy = -0.0372,
        ixz = -0.0668,
        iyz = -0.0468)));

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.4,
    length = 0.3,
    color = {191, 31, 26},
    opacity = 1)
    "Visual 1: \"hull\"";

  UrdfSync.Records.Cylinder visual2(
    origin(
      xyz = {0, 0, -0.35},
      rpy = {0, 0, 0}),
    radius = 0.07,
    length = 0.4,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"keel\"";

  UrdfSync.Records.Sphere visual3(
    origin(
      xyz = {0, 0, -0.58},
      rpy = {0, 0, 0}),
    radius = 0.14,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"ballast\"";

  UrdfSync.Records.Box visual4(
    origin(
      xyz = {0.2, 0.14, 0.21},
      rpy = {0, 0, 0}),
    size = {0.2, 0.16, 0.12},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 4: \"battery\"";

  UrdfSync.Records.Cylinder visual5(
    origin(
      xyz = {0.145, 0, 0.425},
      rpy = {0, -0.35, 0}),
    radius = 0.014,
    length = 0.6,
    color = {191, 31, 26},
    opacity = 1)
    "Visual 5: \"leg_1\"";

  UrdfSync.Records.Cylinder visual6(
    origin(
      xyz = {-0.0725, 0.1256, 0.425},
      rpy = {0, -0.35, 2.0944}),
    radius = 0.014,
    length = 0.6,
    color = {191, 31, 26},
    opacity = 1)
    "Visual 6: \"leg_2\"";

  UrdfSync.Records.Cylinder visual7(
    origin(
      xyz = {-0.0725, -0.1256, 0.425},
      rpy = {0, -0.35, -2.0944}),
    radius = 0.014,
    length = 0.6,
    color = {191, 31, 26},
    opacity = 1)
    "Visual 7: \"leg_3\"";

  UrdfSync.Records.Cylinder visual8(
    origin(
      xyz = {0, 0, 0.71},
      rpy = {0, 0, 0}),
    radius = 0.08,
    length = 0.02,
    color = {191, 31, 26},
    opacity = 1)
    "Visual 8: \"roof\"";

  UrdfSync.Records.Cylinder visual9(
    origin(
      xyz = {0, 0, 0.6},
      rpy = {0, 0, 0}),
    radius = 0.1,
    length = 0.03,
    color = {178, 128, 51},
    opacity = 1)
    "Visual 9: \"bell\"";

  UrdfSync.Records.Sphere visual10(
    origin(
      xyz = {0, 0, 0.75},
      rpy = {0, 0, 0}),
    radius = 0.05,
    color = {242, 217, 76},
    opacity = 0.9)
    "Visual 10: \"lamp\"";

  UrdfSync.Records.Cylinder collision1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.4,
    length = 0.3,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"hull\"";

  UrdfSync.Records.Sphere collision2(
    origin(
      xyz = {0, 0, -0.58},
      rpy = {0, 0, 0}),
    radius = 0.14,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 2: \"ballast\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;buoy&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "aeb4b8f9-a4a5", base = "85d164709da5a864"));
end BuoyParameters;
