within UrdfSync.Examples.WheeledRobot.Links;

record HeadParameters "Numbers of link \"head\""
  extends UrdfSync.Records.Link(
    name = "head",
    inertial(
      origin(
        xyz = {0.0114, 0, 0.0051},
        rpy = {0, 0, 0}),
      mass = 1.1,
      inertia(
        ixx = 0.0028147,
        iyy = 0.0013752,
        izz = 0.0031607,
        ixy = 0,
        ixz = 1.7e-06,
        iyz = 0)));

  UrdfSync.Records.Mesh visual1(
    origin(
      xyz = {0.01, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.WheeledRobot/Resources/head_shell_abd072b6.stl",
    lower = {-0.05000000074505806, -0.08500000089406967, -0.03500000014901161},
    upper = {0.04500000178813934, 0.08500000089406967, 0.044999998062849045},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"shell\"";

  UrdfSync.Records.Box visual2(
    origin(
      xyz = {0.052, 0, 0.005},
      rpy = {0, 0, 0}),
    size = {0.012, 0.13, 0.05},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"face\"";

  UrdfSync.Records.Cylinder visual3(
    origin(
      xyz = {0.062, 0.042, 0.005},
      rpy = {0, 1.5707963, 0}),
    radius = 0.017,
    length = 0.016,
    color = {13, 26, 41},
    opacity = 0.8)
    "Visual 3: \"lens_left\"";

  UrdfSync.Records.Cylinder visual4(
    origin(
      xyz = {0.062, -0.042, 0.005},
      rpy = {0, 1.5707963, 0}),
    radius = 0.017,
    length = 0.016,
    color = {13, 26, 41},
    opacity = 0.8)
    "Visual 4: \"lens_right\"";

  UrdfSync.Records.Sphere visual5(
    origin(
      xyz = {0, 0, 0.047},
      rpy = {0, 0, 0}),
    radius = 0.01,
    color = {242, 140, 13},
    opacity = 1)
    "Visual 5: \"status_light\"";

  UrdfSync.Records.Box collision1(
    origin(
      xyz = {0.012, 0, 0.005},
      rpy = {0, 0, 0}),
    size = {0.116, 0.17, 0.08},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"shell\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;head&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "5dac4e62-a4a5", base = "f010fab0e9b7c7b6"));
end HeadParameters;
