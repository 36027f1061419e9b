within UrdfSync.Examples.WheeledRobot.Joints;

record Drive_rightParameters "Numbers of continuous joint \"drive_right\" from link \"base_link\" to link \"wheel_right\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "drive_right",
    origin(
      xyz = {0, -0.205, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = 15,
      effort = 14),
    dynamics(
      damping = 0.06,
      friction = 0.25),
    transmission(
      reduction = 24,
      offset = 0));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;drive_right&quot; from link &quot;base_link&quot; to link &quot;wheel_right&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "9df8b7d5-352d", base = "0ed2b20e511c1545"));
end Drive_rightParameters;
