within UrdfSync.Examples.WheeledRobot.Links;

record Base_linkParameters "Numbers of link \"base_link\""
  extends UrdfSync.Records.Link(
    name = "base_link",
    inertial(
      origin(
        xyz = {-0.0561, 0, 0.0403},
        rpy = {0, 0, 0}),
      mass = 24,
      inertia(
        ixx = 0.24442,
        iyy = 0.51001,
        izz = 0.65522,
        ixy = 0,
        ixz = 0.02003,
        iyz = 0)));

  UrdfSync.Records.Mesh visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.WheeledRobot/Resources/chassis_044f37ec.stl",
    lower = {-0.33, -0.165, 0},
    upper = {0.19, 0.165, 0.11},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"body\"";

  UrdfSync.Records.Box visual2(
    origin(
      xyz = {-0.01, 0, -0.0275},
      rpy = {0, 0, 0}),
    size = {0.3, 0.29, 0.055},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"battery_and_motors\"";

  UrdfSync.Records.Box visual3(
    origin(
      xyz = {-0.07, 0, 0.114},
      rpy = {0, 0, 0}),
    size = {0.42, 0.24, 0.008},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"deck\"";

  UrdfSync.Records.Box visual4(
    origin(
      xyz = {0.19, 0, 0.03},
      rpy = {0, 0, 0}),
    size = {0.024, 0.2, 0.036},
    color = {26, 26, 26},
    opacity = 1)
    "Visual 4: \"bumper\"";

  UrdfSync.Records.Box visual5(
    origin(
      xyz = {-0.07, 0.165, 0.086},
      rpy = {0, 0, 0}),
    size = {0.34, 0.004, 0.012},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 5: \"stripe_left\"";

  UrdfSync.Records.Box visual6(
    origin(
      xyz = {-0.07, -0.165, 0.086},
      rpy = {0, 0, 0}),
    size = {0.34, 0.004, 0.012},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 6: \"stripe_right\"";

  UrdfSync.Records.Box collision1(
    origin(
      xyz = {-0.07, 0, 0.055},
      rpy = {0, 0, 0}),
    size = {0.52, 0.33, 0.11},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"body\"";

  UrdfSync.Records.Box collision2(
    origin(
      xyz = {-0.01, 0, -0.0275},
      rpy = {0, 0, 0}),
    size = {0.3, 0.29, 0.055},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 2: \"battery_and_motors\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;base_link&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "ee359a99-a4a5", base = "44e844ee8379aeb2"));
end Base_linkParameters;
