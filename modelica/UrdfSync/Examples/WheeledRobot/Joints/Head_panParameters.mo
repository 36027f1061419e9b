within UrdfSync.Examples.WheeledRobot.Joints;

record Head_panParameters "Numbers of revolute joint \"head_pan\" from link \"column\" to link \"neck\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "head_pan",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -2.793,
      upper = 2.793,
      velocity = 3.5,
      effort = 6),
    dynamics(
      damping = 0.12,
      friction = 0.15),
    safetyController(
      k_velocity = 4,
      k_position = 30,
      soft_lower_limit = -2.705,
      soft_upper_limit = 2.705));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;head_pan&quot; from link &quot;column&quot; to link &quot;neck&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "26d902af-352d", base = "01236212b7aeb013"));
end Head_panParameters;
