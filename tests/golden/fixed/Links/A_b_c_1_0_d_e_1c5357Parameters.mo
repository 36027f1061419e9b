within Zoo.Menagerie.Links;

record A_b_c_1_0_d_e_1c5357Parameters "Numbers of link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
  extends UrdfSync.Records.Link(
    name = "a\"b\\ <c> & << 1/0 >> {{d}} %e",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.25,
      inertia(
        ixx = 0.001,
        iyy = 0.001,
        izz = 0.001,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;a&quot;b\\ &lt;c&gt; &amp; &lt;&lt; 1/0 &gt;&gt; {{d}} %e&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end A_b_c_1_0_d_e_1c5357Parameters;
