within Zoo.Menagerie.Joints;

record MountParameters "Numbers of fixed joint \"mount\" from link \"chassis\" to link \"name\""
  extends UrdfSync.Records.FixedJoint(
    name = "mount",
    origin(
      xyz = {0, 0, 0.2},
      rpy = {0, 0, 0}));

  annotation (Documentation(info="<html>
<p>
Numbers of fixed joint &quot;mount&quot; from link &quot;chassis&quot; to link &quot;name&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end MountParameters;
