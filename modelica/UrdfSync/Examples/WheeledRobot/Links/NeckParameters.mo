within UrdfSync.Examples.WheeledRobot.Links;

record NeckParameters "Numbers of link \"neck\""
  extends UrdfSync.Records.Link(
    name = "neck",
    inertial(
      origin(
        xyz = {0, 0, 0.0431},
        rpy = {0, 0, 0}),
      mass = 0.75,
      inertia(
        ixx = 0.0045072,
        iyy = 0.0010468,
        izz = 0.0038265,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0, 0, 0.013},
      rpy = {0, 0, 0}),
    radius = 0.04,
    length = 0.026,
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"turntable\"";

  UrdfSync.Records.Box visual2(
    origin(
      xyz = {0, 0, 0.031},
      rpy = {0, 0, 0}),
    size = {0.044, 0.212, 0.01},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"bridge\"";

  UrdfSync.Records.Box visual3(
    origin(
      xyz = {0, 0.1, 0.07},
      rpy = {0, 0, 0}),
    size = {0.044, 0.012, 0.068},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"cheek_left\"";

  UrdfSync.Records.Box visual4(
    origin(
      xyz = {0, -0.1, 0.07},
      rpy = {0, 0, 0}),
    size = {0.044, 0.012, 0.068},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 4: \"cheek_right\"";

  UrdfSync.Records.Cylinder visual5(
    origin(
      xyz = {0, 0.103, 0.1},
      rpy = {1.5707963, 0, 0}),
    radius = 0.022,
    length = 0.018,
    color = {242, 140, 13},
    opacity = 1)
    "Visual 5: \"cap_left\"";

  UrdfSync.Records.Cylinder visual6(
    origin(
      xyz = {0, -0.103, 0.1},
      rpy = {1.5707963, 0, 0}),
    radius = 0.022,
    length = 0.018,
    color = {242, 140, 13},
    opacity = 1)
    "Visual 6: \"cap_right\"";

  UrdfSync.Records.Cylinder collision1(
    origin(
      xyz = {0, 0, 0.018},
      rpy = {0, 0, 0}),
    radius = 0.045,
    length = 0.036,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"turntable\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;neck&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "5482de1b-a4a5", base = "edc8c6730cd58e2b"));
end NeckParameters;
