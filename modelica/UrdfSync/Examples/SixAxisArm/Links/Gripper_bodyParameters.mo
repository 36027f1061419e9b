within UrdfSync.Examples.SixAxisArm.Links;

record Gripper_bodyParameters "Numbers of link \"gripper_body\""
  extends UrdfSync.Records.Link(
    name = "gripper_body",
    inertial(
      origin(
        xyz = {0, 0, 0.0393},
        rpy = {0, 0, 0}),
      mass = 0.82,
      inertia(
        ixx = 0.0005742,
        iyy = 0.0011987,
        izz = 0.0011859,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0, 0, 0.006},
      rpy = {0, 0, 0}),
    radius = 0.0315,
    length = 0.012,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 1: \"adapter\"";

  UrdfSync.Records.Box visual2(
    origin(
      xyz = {0, 0, 0.042},
      rpy = {0, 0, 0}),
    size = {0.12, 0.06, 0.06},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"housing\"";

  UrdfSync.Records.Box visual3(
    origin(
      xyz = {0, 0.031, 0.042},
      rpy = {0, 0, 0}),
    size = {0.1, 0.004, 0.044},
    color = {0, 120, 153},
    opacity = 1)
    "Visual 3: \"cover_left\"";

  UrdfSync.Records.Box visual4(
    origin(
      xyz = {0, -0.031, 0.042},
      rpy = {0, 0, 0}),
    size = {0.1, 0.004, 0.044},
    color = {0, 120, 153},
    opacity = 1)
    "Visual 4: \"cover_right\"";

  UrdfSync.Records.Box collision1(
    origin(
      xyz = {0, 0, 0.036},
      rpy = {0, 0, 0}),
    size = {0.12, 0.066, 0.072},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"housing\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;gripper_body&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "063c367a-a4a5", base = "c2bba5acfe32ef09"));
end Gripper_bodyParameters;
