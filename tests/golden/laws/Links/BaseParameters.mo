within Rig.Links;

record BaseParameters "Numbers of link \"base\""
  extends UrdfSync.Records.Link(
    name = "base",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 9,
      inertia(
        ixx = 0.5,
        iyy = 0.5,
        izz = 0.5,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0, 0, 0.1},
      rpy = {0.1, 0.2, 0.3}),
    size = {0.3, 0.2, 0.1},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 1";

  UrdfSync.Records.Cylinder visual2(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.1,
    length = 0.5,
    color = {180, 180, 180},
    opacity = 1)
    "Visual 2";

  UrdfSync.Records.Capsule visual3(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.0625,
    length = 0.25,
    color = {180, 180, 180},
    opacity = 1)
    "Visual 3";

  UrdfSync.Records.Sphere visual4(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.125,
    color = {255, 0, 0},
    opacity = 0.5)
    "Visual 4";

  UrdfSync.Records.Mesh visual5(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://Rig/Resources/wedge_a859fdbe.obj",
    lower = {0, 0, 0},
    upper = {0.2, 0.1, 0.05},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 5";

  UrdfSync.Records.Ellipsoid visual6(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radii = {0.25, 0.125, 0.0625},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 6";

  UrdfSync.Records.Sphere collision1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.25,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1";

  UrdfSync.Records.Contact contact(
    mu = 0.75,
    kp = 100000,
    kd = 20,
    minDepth = 0.001)
    "How the link feels at the ground";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;base&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end BaseParameters;
