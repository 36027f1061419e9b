within UrdfSync.Examples.SixAxisArm.Links;

record Finger_rightParameters "Numbers of link \"finger_right\""
  extends UrdfSync.Records.Link(
    name = "finger_right",
    inertial(
      origin(
        xyz = {0.0131, -0.00166, 0.0344},
        rpy = {0, 0, 0}),
      mass = 0.13,
      inertia(
        ixx = 9.631e-05,
        iyy = 0.00010464,
        izz = 4.01e-05,
        ixy = -5.43e-06,
        ixz = 3.98e-06,
        iyz = -6.36e-06)));

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {-0.012, -0.0181, 0.005},
      rpy = {0, 0, 0}),
    size = {0.068, 0.008, 0.01},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 1: \"rack\"";

  UrdfSync.Records.Box visual2(
    origin(
      xyz = {0.0195, 0, 0.017},
      rpy = {0, 0, 0}),
    size = {0.037, 0.046, 0.014},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"carriage\"";

  UrdfSync.Records.Mesh visual3(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/finger_26f93e36.obj",
    lower = {0.004, -0.012, 0.024},
    upper = {0.034, 0.012, 0.096},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"blade\"";

  UrdfSync.Records.Box visual4(
    origin(
      xyz = {0.002, 0, 0.077},
      rpy = {0, 0, 0}),
    size = {0.004, 0.022, 0.032},
    color = {26, 26, 26},
    opacity = 1)
    "Visual 4: \"pad\"";

  UrdfSync.Records.Box collision1(
    origin(
      xyz = {0.0195, 0, 0.017},
      rpy = {0, 0, 0}),
    size = {0.037, 0.046, 0.014},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"carriage\"";

  UrdfSync.Records.Box collision2(
    origin(
      xyz = {0.0105, 0, 0.06},
      rpy = {0, 0, 0}),
    size = {0.02, 0.024, 0.072},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 2: \"blade\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;finger_right&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "ac950fe7-a4a5", base = "fcf73e1e86ad74ec"));
end Finger_rightParameters;
