within UrdfSync.Examples.SixAxisArm.Joints;

record ShoulderParameters "Numbers of revolute joint \"shoulder\" from link \"carousel\" to link \"upper_arm\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "shoulder",
    origin(
      xyz = {0.03, 0, 0.2},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -1.658,
      upper = 2.269,
      velocity = 4.4,
      effort = 280),
    dynamics(
      damping = 15,
      friction = 11),
    calibration(
      rising = 0,
      falling = Modelica.Constants.inf),
    safetyController(
      k_velocity = 110,
      k_position = 60,
      soft_lower_limit = -1.57,
      soft_upper_limit = 2.18));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;shoulder&quot; from link &quot;carousel&quot; to link &quot;upper_arm&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "5cd8ca66-352d", base = "1ce560485e872db2"));
end ShoulderParameters;
