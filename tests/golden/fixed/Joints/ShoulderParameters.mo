within Zoo.Menagerie.Joints;

record ShoulderParameters "Numbers of revolute joint \"shoulder\" from link \"chassis\" to link \"upper arm\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "shoulder",
    origin(
      xyz = {0.2, 0, 0.1},
      rpy = {0, 0.5, 0}),
    axis = {0, 1, 0},
    limits(
      lower = 0.25,
      upper = 2.5,
      velocity = 1.5,
      effort = 150),
    dynamics(
      damping = 0.5,
      friction = 1.25),
    calibration(
      rising = 0.3,
      falling = 2.4),
    safetyController(
      k_velocity = 10,
      k_position = 20,
      soft_lower_limit = 0.3,
      soft_upper_limit = 2.4));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;shoulder&quot; from link &quot;chassis&quot; to link &quot;upper arm&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end ShoulderParameters;
