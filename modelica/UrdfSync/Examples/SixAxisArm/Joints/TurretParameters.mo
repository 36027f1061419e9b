within UrdfSync.Examples.SixAxisArm.Joints;

record TurretParameters "Numbers of revolute joint \"turret\" from link \"base_link\" to link \"carousel\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "turret",
    origin(
      xyz = {0, 0, 0.2},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -2.967,
      upper = 2.967,
      velocity = 5,
      effort = 180),
    dynamics(
      damping = 12,
      friction = 9),
    transmission(
      reduction = 101,
      offset = 0),
    calibration(
      rising = 0,
      falling = Modelica.Constants.inf),
    safetyController(
      k_velocity = 80,
      k_position = 60,
      soft_lower_limit = -2.88,
      soft_upper_limit = 2.88));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;turret&quot; from link &quot;base_link&quot; to link &quot;carousel&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "59908be1-352d", base = "5b8b20a8a58de0bd"));
end TurretParameters;
