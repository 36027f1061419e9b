within UrdfSync.Examples.PlanarPlatform.Joints;

record Boom_swingParameters "Numbers of revolute joint \"boom_swing\" from link \"platform\" to link \"boom\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "boom_swing",
    origin(
      xyz = {0.06, -0.04, 0.16},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -2.6,
      upper = 2.6,
      velocity = 3,
      effort = 6),
    dynamics(
      damping = 0.15,
      friction = 0.08));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;boom_swing&quot; from link &quot;platform&quot; to link &quot;boom&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "6e6995ca-352d", base = "32fcceefb3b0b393"));
end Boom_swingParameters;
