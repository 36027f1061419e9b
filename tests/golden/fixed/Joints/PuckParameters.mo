within Zoo.Menagerie.Joints;

record PuckParameters "Numbers of planar joint \"puck\" from link \"table\" to link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
  extends UrdfSync.Records.PlanarJoint(
    name = "puck",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1});

  annotation (Documentation(info="<html>
<p>
Numbers of planar joint &quot;puck&quot; from link &quot;table&quot; to link &quot;a&quot;b\\ &lt;c&gt; &amp; &lt;&lt; 1/0 &gt;&gt; {{d}} %e&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end PuckParameters;
