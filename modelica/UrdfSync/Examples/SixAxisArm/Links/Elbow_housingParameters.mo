within UrdfSync.Examples.SixAxisArm.Links;

record Elbow_housingParameters "Numbers of link \"elbow_housing\""
  extends UrdfSync.Records.Link(
    name = "elbow_housing",
    inertial(
      origin(
        xyz = {0.0158, 0.0001, 0.0313},
        rpy = {0, 0, 0}),
      mass = 8,
      inertia(
        ixx = 0.020434,
        iyy = 0.051526,
        izz = 0.047097,
        ixy = 0.000145,
        ixz = -0.000213,
        iyz = -1.7e-05)));

  UrdfSync.Records.Mesh visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync.Examples.SixAxisArm/Resources/elbow_housing_4beb27d3.obj",
    lower = {-0.1, -0.056, -0.062},
    upper = {0.13, 0.056, 0.098},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 1: \"body\"";

  UrdfSync.Records.Cylinder visual2(
    origin(
      xyz = {0.138, 0, 0.04},
      rpy = {0, 1.5707963, 0}),
    radius = 0.052,
    length = 0.024,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"bearing_ring\"";

  UrdfSync.Records.Cylinder visual3(
    origin(
      xyz = {-0.12, 0.026, 0.05},
      rpy = {0, 1.5707963, 0}),
    radius = 0.023,
    length = 0.05,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"roll_motor\"";

  UrdfSync.Records.Cylinder visual4(
    origin(
      xyz = {-0.115, -0.026, 0.05},
      rpy = {0, 1.5707963, 0}),
    radius = 0.023,
    length = 0.04,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 4: \"pitch_motor\"";

  UrdfSync.Records.Box visual5(
    origin(
      xyz = {0.06, 0, 0.098},
      rpy = {0, 0, 0}),
    size = {0.07, 0.06, 0.004},
    color = {0, 120, 153},
    opacity = 1)
    "Visual 5: \"stripe\"";

  UrdfSync.Records.Box collision1(
    origin(
      xyz = {0.005, 0, 0.03},
      rpy = {0, 0, 0}),
    size = {0.29, 0.112, 0.14},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"body\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;elbow_housing&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "36e667d2-a4a5", base = "e0900e1efb793041"));
end Elbow_housingParameters;
