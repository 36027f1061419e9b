within UrdfSync.Examples.SixAxisArm.Links;

record Base_linkParameters "Numbers of link \"base_link\""
  extends UrdfSync.Records.Link(
    name = "base_link",
    inertial(
      origin(
        xyz = {-0.008, 0, 0.0817},
        rpy = {0, 0, 0}),
      mass = 15.5,
      inertia(
        ixx = 0.09709,
        iyy = 0.111,
        izz = 0.10437,
        ixy = 0,
        ixz = 0.00041,
        iyz = 0)));

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0, 0, 0.015},
      rpy = {0, 0, 0}),
    size = {0.26, 0.24, 0.03},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 1: \"foot\"";

  UrdfSync.Records.Mesh visual2(
    origin(
      xyz = {0, 0, 0.03},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/base_casting_d67b161a.stl",
    lower = {-0.11, -0.11, 0},
    upper = {0.11, 0.11, 0.17},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 2: \"casting\"";

  UrdfSync.Records.Box visual3(
    origin(
      xyz = {-0.1, 0, 0.085},
      rpy = {0, 0, 0}),
    size = {0.06, 0.11, 0.09},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"connector_panel\"";

  UrdfSync.Records.Cylinder visual4(
    origin(
      xyz = {0.11, 0.1, 0.036},
      rpy = {0, 0, 0}),
    radius = 0.009,
    length = 0.012,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 4: \"bolt_1\"";

  UrdfSync.Records.Cylinder visual5(
    origin(
      xyz = {-0.11, 0.1, 0.036},
      rpy = {0, 0, 0}),
    radius = 0.009,
    length = 0.012,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 5: \"bolt_2\"";

  UrdfSync.Records.Cylinder visual6(
    origin(
      xyz = {-0.11, -0.1, 0.036},
      rpy = {0, 0, 0}),
    radius = 0.009,
    length = 0.012,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 6: \"bolt_3\"";

  UrdfSync.Records.Cylinder visual7(
    origin(
      xyz = {0.11, -0.1, 0.036},
      rpy = {0, 0, 0}),
    radius = 0.009,
    length = 0.012,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 7: \"bolt_4\"";

  UrdfSync.Records.Box collision1(
    origin(
      xyz = {0, 0, 0.015},
      rpy = {0, 0, 0}),
    size = {0.26, 0.24, 0.03},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"foot\"";

  UrdfSync.Records.Cylinder collision2(
    origin(
      xyz = {0, 0, 0.115},
      rpy = {0, 0, 0}),
    radius = 0.11,
    length = 0.17,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 2: \"casting\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;base_link&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "ee359a99-a4a5", base = "d8da0ac2b141452d"));
end Base_linkParameters;
