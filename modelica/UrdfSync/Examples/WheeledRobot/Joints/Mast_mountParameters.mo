within UrdfSync.Examples.WheeledRobot.Joints;

record Mast_mountParameters "Numbers of fixed joint \"mast_mount\" from link \"base_link\" to link \"lidar_mast\""
  extends UrdfSync.Records.FixedJoint(
    name = "mast_mount",
    origin(
      xyz = {0.1, 0, 0.11},
      rpy = {0, 0, 0}));

  annotation (Documentation(info="<html>
<p>
Numbers of fixed joint &quot;mast_mount&quot; from link &quot;base_link&quot; to link &quot;lidar_mast&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "ef89457d-352d", base = "f493fdbc386da8a9"));
end Mast_mountParameters;
