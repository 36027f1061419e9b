within Arm.Links;

record UpperParameters "Numbers of link \"upper\""
  extends UrdfSync.Records.Link(
    name = "upper",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1.5,
      inertia(
        ixx = 0.1,
        iyy = 0.1,
        izz = 0.1,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.1, 0.1, 0.5},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 1";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;upper&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "c7d169ad-a4a5", base = "af44426a4b666787"));
end UpperParameters;
