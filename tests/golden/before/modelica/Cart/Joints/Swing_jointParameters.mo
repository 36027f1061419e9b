within Cart.Joints;

record Swing_jointParameters "Numbers of revolute joint \"swing\" from link \"base\" to link \"swingAxis\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "swing",
    origin(
      xyz = {0, 0, 0.1},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -1,
      upper = 2,
      velocity = 3,
      effort = 40),
    dynamics(
      damping = 0.1,
      friction = 0));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;swing&quot; from link &quot;base&quot; to link &quot;swingAxis&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end Swing_jointParameters;
