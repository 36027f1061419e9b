within UrdfSync.Examples.WheeledRobot.Joints;

record LiftParameters "Numbers of prismatic joint \"lift\" from link \"column_guide\" to link \"column\""
  extends UrdfSync.Records.PrismaticJoint(
    name = "lift",
    origin(
      xyz = {0, 0, 0.45},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = 0,
      upper = 0.35,
      velocity = 0.08,
      effort = 300),
    dynamics(
      damping = 220,
      friction = 24),
    calibration(
      rising = Modelica.Constants.inf,
      falling = 0),
    safetyController(
      k_velocity = 2000,
      k_position = 15,
      soft_lower_limit = 0.005,
      soft_upper_limit = 0.345));

  annotation (Documentation(info="<html>
<p>
Numbers of prismatic joint &quot;lift&quot; from link &quot;column_guide&quot; to link &quot;column&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "ef6cdf19-352d", base = "446a723eff78696f"));
end LiftParameters;
