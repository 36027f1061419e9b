within UrdfSync.Examples.WheeledRobot.Links;

record Wheel_rightParameters "Numbers of link \"wheel_right\""
  extends UrdfSync.Records.Link(
    name = "wheel_right",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1.6,
      inertia(
        ixx = 0.0031481,
        iyy = 0.0058284,
        izz = 0.0031481,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Mesh visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.WheeledRobot/Resources/tyre_a7d9190a.obj",
    lower = {-0.1, -0.02, -0.1},
    upper = {0.1, 0.02, 0.1},
    color = {26, 26, 26},
    opacity = 1)
    "Visual 1: \"tyre\"";

  UrdfSync.Records.Cylinder visual2(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.07,
    length = 0.044,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"rim\"";

  UrdfSync.Records.Box visual3(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.13, 0.048, 0.014},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 3: \"spoke_1\"";

  UrdfSync.Records.Box visual4(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 1.0472, 0}),
    size = {0.13, 0.048, 0.014},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 4: \"spoke_2\"";

  UrdfSync.Records.Box visual5(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 2.0944, 0}),
    size = {0.13, 0.048, 0.014},
    color = {242, 140, 13},
    opacity = 1)
    "Visual 5: \"spoke_3\"";

  UrdfSync.Records.Cylinder collision1(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.1,
    length = 0.04,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"tyre\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;wheel_right&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "c8464579-a4a5", base = "cffd3ca2fc517149"));
end Wheel_rightParameters;
