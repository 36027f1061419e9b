within Zoo.Menagerie.Joints;

record TetherParameters "Numbers of floating joint \"tether\" from link \"chassis\" to link \"balloon\""
  extends UrdfSync.Records.FloatingJoint(
    name = "tether",
    origin(
      xyz = {0, 0, 1},
      rpy = {0, 0, 0}));

  annotation (Documentation(info="<html>
<p>
Numbers of floating joint &quot;tether&quot; from link &quot;chassis&quot; to link &quot;balloon&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end TetherParameters;
