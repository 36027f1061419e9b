within UrdfSync.Examples.PlanarPlatform.Links;

record PlatformParameters "Numbers of link \"platform\""
  extends UrdfSync.Records.Link(
    name = "platform",
    inertial(
      origin(
        xyz = {-0.0047, 0.0136, 0.0429},
        rpy = {0, 0, 0}),
      mass = 9.5,
      inertia(
        ixx = 0.0878,
        iyy = 0.08359,
        izz = 0.15454,
        ixy = 0.01154,
        ixz = 6e-05,
        iyz = -0.00324)));

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0.13, 0, 0.01},
      rpy = {0, 0, 0}),
    radius = 0.04,
    length = 0.02,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 1: \"pad_1\"";

  UrdfSync.Records.Cylinder visual2(
    origin(
      xyz = {-0.065, 0.1126, 0.01},
      rpy = {0, 0, 0}),
    radius = 0.04,
    length = 0.02,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"pad_2\"";

  UrdfSync.Records.Cylinder visual3(
    origin(
      xyz = {-0.065, -0.1126, 0.01},
      rpy = {0, 0, 0}),
    radius = 0.04,
    length = 0.02,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 3: \"pad_3\"";

  UrdfSync.Records.Cylinder visual4(
    origin(
      xyz = {0, 0, 0.03},
      rpy = {0, 0, 0}),
    radius = 0.19,
    length = 0.02,
    color = {230, 230, 222},
    opacity = 1)
    "Visual 4: \"deck\"";

  UrdfSync.Records.Cylinder visual5(
    origin(
      xyz = {-0.06, 0.1, 0.075},
      rpy = {0, 1.5707963, 0}),
    radius = 0.035,
    length = 0.16,
    color = {89, 140, 51},
    opacity = 1)
    "Visual 5: \"air_bottle\"";

  UrdfSync.Records.Cylinder visual6(
    origin(
      xyz = {0.06, -0.04, 0.1},
      rpy = {0, 0, 0}),
    radius = 0.03,
    length = 0.12,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 6: \"pillar\"";

  UrdfSync.Records.Cylinder collision1(
    origin(
      xyz = {0, 0, 0.02},
      rpy = {0, 0, 0}),
    radius = 0.19,
    length = 0.04,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"deck\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;platform&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "52400519-a4a5", base = "4a09c5706f716f4c"));
end PlatformParameters;
