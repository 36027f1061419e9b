within Zoo.Menagerie.Links;

record ChassisParameters "Numbers of link \"chassis\""
  extends UrdfSync.Records.Link(
    name = "chassis",
    inertial(
      origin(
        xyz = {0.01, -0.02, 0.03},
        rpy = {0.1, -0.2, 0.3}),
      mass = 12.5,
      inertia(
        ixx = 0.3,
        iyy = 0.25,
        izz = 0.2,
        ixy = 0.001,
        ixz = -0.002,
        iyz = 1e-05)));

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0, 0, 0.05},
      rpy = {0, 0, 1.5707963267948966}),
    size = {0.6, 0.4, 0.1},
    color = {128, 128, 140},
    opacity = 1)
    "Visual 1: \"tub\"";

  UrdfSync.Records.Cylinder visual2(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.1,
    length = 0.3,
    color = {255, 0, 128},
    opacity = 0.25)
    "Visual 2";

  UrdfSync.Records.Capsule visual3(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.02,
    length = 0.4,
    color = {180, 180, 180},
    opacity = 1)
    "Visual 3: \"bumper \"front\"\"";

  UrdfSync.Records.Sphere visual4(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.05,
    color = {180, 180, 180},
    opacity = 1)
    "Visual 4";

  UrdfSync.Records.Mesh visual5(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://Zoo.Menagerie/Resources/wedge_a859fdbe.obj",
    lower = {0, 0, 0},
    upper = {0.2, 0.1, 0.05},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 5: \"wedge\"";

  UrdfSync.Records.Mesh visual7(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://Zoo.Menagerie/Resources/wedge_a691ff4a.stl",
    lower = {0, 0, -0.05},
    upper = {0.4, 0.2, 0},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 7: \"ramp\"";

  UrdfSync.Records.Ellipsoid visual8(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radii = {0.1, 0.2, 0.05},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 8: \"egg\"";

  UrdfSync.Records.Box collision1(
    origin(
      xyz = {0, 0, 0.05},
      rpy = {0, 0, 0}),
    size = {0.6, 0.4, 0.1},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"tub\"";

  UrdfSync.Records.Cylinder collision2(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.1,
    length = 0.3,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 2";

  UrdfSync.Records.Capsule collision3(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.02,
    length = 0.4,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 3";

  UrdfSync.Records.Sphere collision4(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.05,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 4";

  UrdfSync.Records.Mesh collision5(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://Zoo.Menagerie/Resources/wedge_a859fdbe.obj",
    lower = {0, 0, 0},
    upper = {0.2, 0.1, 0.05},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 5: \"wedge\"";

  Modelica.Units.SI.Position collision5Corners[6, 3] = {
    {0, 0, 0},
    {0, 0, 0.05},
    {0, 0.1, 0},
    {0, 0.1, 0.05},
    {0.2, 0, 0},
    {0.2, 0.1, 0}}
    "Outermost points of collision5, resolved in its shape frame";

  UrdfSync.Records.Ellipsoid collision7(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radii = {0.1, 0.2, 0.05},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 7: \"egg\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;chassis&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end ChassisParameters;
