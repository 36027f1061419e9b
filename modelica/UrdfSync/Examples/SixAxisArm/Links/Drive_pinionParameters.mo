within UrdfSync.Examples.SixAxisArm.Links;

record Drive_pinionParameters "Numbers of link \"drive_pinion\""
  extends UrdfSync.Records.Link(
    name = "drive_pinion",
    inertial(
      origin(
        xyz = {0, 0, 0.00183},
        rpy = {0, 0, 0}),
      mass = 0.045,
      inertia(
        ixx = 3.4535e-06,
        iyy = 3.4535e-06,
        izz = 2.5842e-06,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Mesh visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/drive_pinion_006c7beb.stl",
    lower = {-0.013737000465393067, -0.013737000465393067, 0},
    upper = {0.013737000465393067, 0.013737000465393067, 0.01},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 1: \"gear\"";

  UrdfSync.Records.Cylinder visual2(
    origin(
      xyz = {0, 0, -0.005},
      rpy = {0, 0, 0}),
    radius = 0.005,
    length = 0.028,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"shaft\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;drive_pinion&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "8c4bacf9-a4a5", base = "bd50f1b63326bfc0"));
end Drive_pinionParameters;
