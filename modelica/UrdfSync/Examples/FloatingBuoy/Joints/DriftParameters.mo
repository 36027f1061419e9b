within UrdfSync.Examples.FloatingBuoy.Joints;

record DriftParameters "Numbers of floating joint \"drift\" from link \"world\" to link \"buoy\""
  extends UrdfSync.Records.FloatingJoint(
    name = "drift",
    origin(
      xyz = {0, 0, 1.2},
      rpy = {0, 0, 0.5}));

  annotation (Documentation(info="<html>
<p>
Numbers of floating joint &quot;drift&quot; from link &quot;world&quot; to link &quot;buoy&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "1428f346-352d", base = "fffac6870e168807"));
end DriftParameters;
