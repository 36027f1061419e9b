within UrdfSync.Examples.WheeledRobot.Joints;

record Camera_mountParameters "Numbers of fixed joint \"camera_mount\" from link \"head\" to link \"camera_optical_frame\""
  extends UrdfSync.Records.FixedJoint(
    name = "camera_mount",
    origin(
      xyz = {0.07, 0.042, 0.005},
      rpy = {-1.5707963, 0, -1.5707963}));

  annotation (Documentation(info="<html>
<p>
Numbers of fixed joint &quot;camera_mount&quot; from link &quot;head&quot; to link &quot;camera_optical_frame&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "33a8b7a3-352d", base = "188083e8501c99da"));
end Camera_mountParameters;
