within UrdfSync.Examples.WheeledRobot.Links;

record ColumnParameters "Numbers of link \"column\""
  extends UrdfSync.Records.Link(
    name = "column",
    inertial(
      origin(
        xyz = {0, 0, -0.2065},
        rpy = {0, 0, 0}),
      mass = 2.1,
      inertia(
        ixx = 0.032383,
        iyy = 0.032588,
        izz = 0.001344,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0, 0, -0.215},
      rpy = {0, 0, 0}),
    size = {0.066, 0.056, 0.41},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 1: \"profile\"";

  UrdfSync.Records.Cylinder visual2(
    origin(
      xyz = {0, 0, -0.005},
      rpy = {0, 0, 0}),
    radius = 0.045,
    length = 0.01,
    color = {51, 56, 61},
    opacity = 1)
    "Visual 2: \"top_plate\"";

  UrdfSync.Records.Box collision1(
    origin(
      xyz = {0, 0, -0.21},
      rpy = {0, 0, 0}),
    size = {0.066, 0.056, 0.42},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"profile\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;column&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "1f0d03fc-a4a5", base = "10b60df745a1361d"));
end ColumnParameters;
