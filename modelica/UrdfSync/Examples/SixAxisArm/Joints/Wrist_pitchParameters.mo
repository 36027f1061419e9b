within UrdfSync.Examples.SixAxisArm.Joints;

record Wrist_pitchParameters "Numbers of revolute joint \"wrist_pitch\" from link \"forearm\" to link \"wrist\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "wrist_pitch",
    origin(
      xyz = {0.27, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -2.182,
      upper = 2.182,
      velocity = 7,
      effort = 26),
    dynamics(
      damping = 0.9,
      friction = 1.3));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;wrist_pitch&quot; from link &quot;forearm&quot; to link &quot;wrist&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "eeb0a3f3-352d", base = "06cbceb17ee46e2a"));
end Wrist_pitchParameters;
