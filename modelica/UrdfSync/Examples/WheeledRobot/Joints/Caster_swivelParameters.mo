within UrdfSync.Examples.WheeledRobot.Joints;

record Caster_swivelParameters "Numbers of continuous joint \"caster_swivel\" from link \"base_link\" to link \"caster_fork\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "caster_swivel",
    origin(
      xyz = {-0.25, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf),
    dynamics(
      damping = 0.01,
      friction = 0.03));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;caster_swivel&quot; from link &quot;base_link&quot; to link &quot;caster_fork&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "e960663b-352d", base = "4463370e05dbc698"));
end Caster_swivelParameters;
