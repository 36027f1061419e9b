within Zoo.Menagerie.Links;

record L_arm_link_6c89e3Parameters "Numbers of link \"l_arm\""
  extends UrdfSync.Records.Link(
    name = "l_arm",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 2,
      inertia(
        ixx = 0.02,
        iyy = 0.02,
        izz = 0.02,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;l_arm&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end L_arm_link_6c89e3Parameters;
