within UrdfSync.Examples.WheeledRobot.Joints;

record Head_tiltParameters "Numbers of revolute joint \"head_tilt\" from link \"neck\" to link \"head\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "head_tilt",
    origin(
      xyz = {0, 0, 0.1},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -0.698,
      upper = 1.047,
      velocity = 3.5,
      effort = 4),
    dynamics(
      damping = 0.08,
      friction = 0.1),
    safetyController(
      k_velocity = 3,
      k_position = 30,
      soft_lower_limit = -0.61,
      soft_upper_limit = 0.96));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;head_tilt&quot; from link &quot;neck&quot; to link &quot;head&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "4907c2a5-352d", base = "3e7b5ff6e37f58aa"));
end Head_tiltParameters;
