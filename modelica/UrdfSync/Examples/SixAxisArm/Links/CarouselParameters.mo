within UrdfSync.Examples.SixAxisArm.Links;

record CarouselParameters "Numbers of link \"carousel\""
  extends UrdfSync.Records.Link(
    name = "carousel",
    inertial(
      origin(
        xyz = {0.003, 0, 0.1141},
        rpy = {0, 0.382, 0}),
      mass = 11.5,
      inertia(
        ixx = 0.081982,
        iyy = 0.097568,
        izz = 0.044031,
        ixy = 0,
        ixz = -1.6e-05,
        iyz = 0)));

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0, 0, 0.016},
      rpy = {0, 0, 0}),
    radius = 0.096,
    length = 0.03,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 1: \"turntable\"";

  UrdfSync.Records.Mesh visual2(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/carousel_325c5c27.obj",
    lower = {-0.082, -0.058, 0},
    upper = {0.102, 0.058, 0.272},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 2: \"body\"";

  UrdfSync.Records.Cylinder visual3(
    origin(
      xyz = {-0.098, 0, 0.076},
      rpy = {0, 0, 0}),
    radius = 0.042,
    length = 0.09,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"turret_motor\"";

  UrdfSync.Records.Cylinder collision1(
    origin(
      xyz = {0, 0, 0.016},
      rpy = {0, 0, 0}),
    radius = 0.096,
    length = 0.03,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"turntable\"";

  UrdfSync.Records.Mesh collision2(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/carousel_325c5c27.obj",
    lower = {-0.082, -0.058, 0},
    upper = {0.102, 0.058, 0.272},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 2: \"body\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;carousel&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "26ce1b4f-a4a5", base = "889021e5c660aa61"));
end CarouselParameters;
