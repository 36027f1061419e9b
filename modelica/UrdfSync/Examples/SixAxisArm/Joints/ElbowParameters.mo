within UrdfSync.Examples.SixAxisArm.Joints;

record ElbowParameters "Numbers of revolute joint \"elbow\" from link \"upper_arm\" to link \"elbow_housing\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "elbow",
    origin(
      xyz = {0, 0, 0.44},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -3.49,
      upper = 1.222,
      velocity = 5,
      effort = 130),
    dynamics(
      damping = 8,
      friction = 6.5),
    calibration(
      rising = 0,
      falling = Modelica.Constants.inf),
    safetyController(
      k_velocity = 50,
      k_position = 60,
      soft_lower_limit = -3.4,
      soft_upper_limit = 1.13));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;elbow&quot; from link &quot;upper_arm&quot; to link &quot;elbow_housing&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "056fd1cc-352d", base = "a6ed3cead5e7c15b"));
end ElbowParameters;
