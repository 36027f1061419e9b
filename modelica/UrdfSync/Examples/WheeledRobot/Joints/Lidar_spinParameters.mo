within UrdfSync.Examples.WheeledRobot.Joints;

record Lidar_spinParameters "Numbers of continuous joint \"lidar_spin\" from link \"lidar_mast\" to link \"lidar\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "lidar_spin",
    origin(
      xyz = {0, 0, 0.15},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = 63,
      effort = 0.12),
    dynamics(
      damping = 0.0004,
      friction = 0.002));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;lidar_spin&quot; from link &quot;lidar_mast&quot; to link &quot;lidar&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "7d3f01b0-352d", base = "1d3c1f337d6bda76"));
end Lidar_spinParameters;
