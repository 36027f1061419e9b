within Arm.Links;

record UpperParameters "Numbers of link \"upper\""
  extends UrdfSync.Records.Link(
    name = "upper",
    inertial(
      origin(
        xyz = {0, 0, 0.2},
        rpy = {0, 0, 0}),
      mass = 1.5,
      inertia(
        ixx = 0.02,
        iyy = 0.02,
        izz = 0.01,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;upper&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "c7d169ad-a4a5", base = "dde108636cf7d21f"));
end UpperParameters;
