within Arm.Links;

record BoomParameters "Numbers of link \"boom\""
  extends UrdfSync.Records.Link(
    name = "boom",
    inertial(
      origin(
        xyz = {0.3, 0, 0},
        rpy = {0, 0, 0}),
      mass = 2,
      inertia(
        ixx = 0.01,
        iyy = 0.1,
        izz = 0.1,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0.3, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.6, 0.05, 0.05},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 1";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;boom&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end BoomParameters;
