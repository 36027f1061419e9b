within UrdfSync.Examples.SixAxisArm.Links;

record ForearmParameters "Numbers of link \"forearm\""
  extends UrdfSync.Records.Link(
    name = "forearm",
    inertial(
      origin(
        xyz = {0.1118, 0, 0},
        rpy = {0, 0, 0}),
      mass = 4.2,
      inertia(
        ixx = 0.005953,
        iyy = 0.029335,
        izz = 0.030752,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Mesh visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/forearm_tube_ca766f70.stl",
    lower = {0, -0.058, -0.058},
    upper = {0.17, 0.058, 0.058},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"tube\"";

  UrdfSync.Records.Box visual2(
    origin(
      xyz = {0.18, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.024, 0.104, 0.06},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"bridge\"";

  UrdfSync.Records.Box visual3(
    origin(
      xyz = {0.23, 0.043, 0},
      rpy = {0, 0, 0}),
    size = {0.08, 0.018, 0.056},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 3: \"fork_left\"";

  UrdfSync.Records.Box visual4(
    origin(
      xyz = {0.23, -0.043, 0},
      rpy = {0, 0, 0}),
    size = {0.08, 0.018, 0.056},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 4: \"fork_right\"";

  UrdfSync.Records.Cylinder visual5(
    origin(
      xyz = {0.27, 0.045, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.03,
    length = 0.022,
    color = {0, 120, 153},
    opacity = 1)
    "Visual 5: \"fork_cap_left\"";

  UrdfSync.Records.Cylinder visual6(
    origin(
      xyz = {0.27, -0.045, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.03,
    length = 0.022,
    color = {0, 120, 153},
    opacity = 1)
    "Visual 6: \"fork_cap_right\"";

  UrdfSync.Records.Cylinder collision1(
    origin(
      xyz = {0.085, 0, 0},
      rpy = {0, 1.5707963, 0}),
    radius = 0.058,
    length = 0.17,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"tube\"";

  UrdfSync.Records.Box collision2(
    origin(
      xyz = {0.235, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.13, 0.112, 0.06},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 2: \"fork\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;forearm&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "6528f35f-a4a5", base = "8365f08f4f0f115a"));
end ForearmParameters;
