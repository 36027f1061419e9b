within Zoo.Menagerie.Joints;

record LiftParameters "Numbers of prismatic joint \"lift\" from link \"chassis\" to link \"l_arm\""
  extends UrdfSync.Records.PrismaticJoint(
    name = "lift",
    origin(
      xyz = {-0.2, 0, 0.1},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -0.05,
      upper = 0.4,
      velocity = 0.25,
      effort = 500),
    dynamics(
      damping = 100,
      friction = 0),
    calibration(
      rising = Modelica.Constants.inf,
      falling = 0.35),
    safetyController(
      k_velocity = 5,
      k_position = 0,
      soft_lower_limit = 0,
      soft_upper_limit = 0));

  annotation (Documentation(info="<html>
<p>
Numbers of prismatic joint &quot;lift&quot; from link &quot;chassis&quot; to link &quot;l_arm&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end LiftParameters;
