within UrdfSync.Examples.SixAxisArm.Joints;

record Flange_rollParameters "Numbers of revolute joint \"flange_roll\" from link \"wrist\" to link \"mounting_flange\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "flange_roll",
    origin(
      xyz = {0.068, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -6.981,
      upper = 6.981,
      velocity = 10.5,
      effort = 13),
    dynamics(
      damping = 0.35,
      friction = 0.7));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;flange_roll&quot; from link &quot;wrist&quot; to link &quot;mounting_flange&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "eb608c84-352d", base = "393c8d681c5f2f1e"));
end Flange_rollParameters;
