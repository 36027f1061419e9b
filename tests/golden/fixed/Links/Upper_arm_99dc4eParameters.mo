within Zoo.Menagerie.Links;

record Upper_arm_99dc4eParameters "Numbers of link \"upper arm\""
  extends UrdfSync.Records.Link(
    name = "upper arm",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 3,
      inertia(
        ixx = 0.01,
        iyy = 0.01,
        izz = 0.01,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;upper arm&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end Upper_arm_99dc4eParameters;
