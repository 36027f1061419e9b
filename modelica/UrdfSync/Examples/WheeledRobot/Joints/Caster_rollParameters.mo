within UrdfSync.Examples.WheeledRobot.Joints;

record Caster_rollParameters "Numbers of continuous joint \"caster_roll\" from link \"caster_fork\" to link \"caster_wheel\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "caster_roll",
    origin(
      xyz = {-0.03, 0, -0.06},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf),
    dynamics(
      damping = 0.002,
      friction = 0.01));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;caster_roll&quot; from link &quot;caster_fork&quot; to link &quot;caster_wheel&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "075170dd-352d", base = "1f6879a0940caa5f"));
end Caster_rollParameters;
