within Zoo.Menagerie.Joints;

record RotationalParameters "Numbers of continuous joint \"rotational\" from link \"chassis\" to link \"CON\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "rotational",
    origin(
      xyz = {0, 0.25, -0.05},
      rpy = {-1.5707963267948966, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = 30,
      effort = 12),
    dynamics(
      damping = 0,
      friction = 0.01),
    calibration(
      rising = 0.5,
      falling = Modelica.Constants.inf),
    safetyController(
      k_velocity = 0.5,
      k_position = 0,
      soft_lower_limit = 0,
      soft_upper_limit = 0));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;rotational&quot; from link &quot;chassis&quot; to link &quot;CON&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end RotationalParameters;
