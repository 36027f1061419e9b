within UrdfSync.Examples.SixAxisArm.Links;

record Upper_armParameters "Numbers of link \"upper_arm\""
  extends UrdfSync.Records.Link(
    name = "upper_arm",
    inertial(
      origin(
        xyz = {0, 0, 0.1949},
        rpy = {0, 0, 0}),
      mass = 10.5,
      inertia(
        ixx = 0.32715,
        iyy = 0.29181,
        izz = 0.05616,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Mesh visual1(
    origin(
      xyz = {0, 0.06, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/upper_arm_side_732fcd09.stl",
    lower = {-0.07400000095367432, 0, -0.07400000095367432},
    upper = {0.07400000095367432, 0.03800000064074993, 0.5019999742507935},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"side_left\"";

  UrdfSync.Records.Mesh visual2(
    origin(
      xyz = {0, -0.06, 0},
      rpy = {0, 0, 3.1415927}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/upper_arm_side_732fcd09.stl",
    lower = {-0.07400000095367432, 0, -0.07400000095367432},
    upper = {0.07400000095367432, 0.03800000064074993, 0.5019999742507935},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 2: \"side_right\"";

  UrdfSync.Records.Box visual3(
    origin(
      xyz = {0, 0, 0.195},
      rpy = {0, 0, 0}),
    size = {0.08, 0.124, 0.15},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"web\"";

  UrdfSync.Records.Cylinder visual4(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.042,
    length = 0.204,
    color = {0, 120, 153},
    opacity = 1)
    "Visual 4: \"shoulder_cap\"";

  UrdfSync.Records.Cylinder visual5(
    origin(
      xyz = {0, 0, 0.44},
      rpy = {1.5707963, 0, 0}),
    radius = 0.034,
    length = 0.204,
    color = {0, 120, 153},
    opacity = 1)
    "Visual 5: \"elbow_cap\"";

  UrdfSync.Records.Box collision1(
    origin(
      xyz = {0, 0, 0.22},
      rpy = {0, 0, 0}),
    size = {0.124, 0.196, 0.44},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"beam\"";

  UrdfSync.Records.Cylinder collision2(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.074,
    length = 0.196,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 2: \"shoulder_end\"";

  UrdfSync.Records.Cylinder collision3(
    origin(
      xyz = {0, 0, 0.44},
      rpy = {1.5707963, 0, 0}),
    radius = 0.062,
    length = 0.196,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 3: \"elbow_end\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;upper_arm&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "32685676-a4a5", base = "49b2c2a438edacb3"));
end Upper_armParameters;
