within UrdfSync.Examples.WheeledRobot.Links;

record Column_guideParameters "Numbers of link \"column_guide\""
  extends UrdfSync.Records.Link(
    name = "column_guide",
    inertial(
      origin(
        xyz = {-0.0041, 0, 0.1939},
        rpy = {0, 0, 0}),
      mass = 3.6,
      inertia(
        ixx = 0.062894,
        iyy = 0.064336,
        izz = 0.005759,
        ixy = 0,
        ixz = -0.001689,
        iyz = 0)));

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0, 0, 0.01},
      rpy = {0, 0, 0}),
    size = {0.14, 0.13, 0.02},
    color = {51, 56, 61},
    opacity = 1)
    "Visual 1: \"foot\"";

  UrdfSync.Records.Box visual2(
    origin(
      xyz = {0, 0, 0.225},
      rpy = {0, 0, 0}),
    size = {0.09, 0.08, 0.41},
    color = {230, 230, 222},
    opacity = 1)
    "Visual 2: \"profile\"";

  UrdfSync.Records.Cylinder visual3(
    origin(
      xyz = {-0.067, 0, 0.08},
      rpy = {0, 0, 0}),
    radius = 0.024,
    length = 0.12,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 3: \"lift_motor\"";

  UrdfSync.Records.Box collision1(
    origin(
      xyz = {0, 0, 0.215},
      rpy = {0, 0, 0}),
    size = {0.09, 0.08, 0.43},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"profile\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;column_guide&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "4b39e45c-a4a5", base = "d80a18d29a5b55c5"));
end Column_guideParameters;
