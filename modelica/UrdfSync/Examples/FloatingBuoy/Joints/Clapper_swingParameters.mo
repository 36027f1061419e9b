within UrdfSync.Examples.FloatingBuoy.Joints;

record Clapper_swingParameters "Numbers of continuous joint \"clapper_swing\" from link \"buoy\" to link \"clapper\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "clapper_swing",
    origin(
      xyz = {0, 0, 0.56},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf),
    dynamics(
      damping = 0.01,
      friction = 0.02));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;clapper_swing&quot; from link &quot;buoy&quot; to link &quot;clapper&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "76f29b76-352d", base = "dc74d11080fb1e88"));
end Clapper_swingParameters;
