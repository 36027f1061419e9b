within UrdfSync.Examples.SixAxisArm.Joints;

record Forearm_rollParameters "Numbers of revolute joint \"forearm_roll\" from link \"elbow_housing\" to link \"forearm\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "forearm_roll",
    origin(
      xyz = {0.15, 0, 0.04},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -4.712,
      upper = 4.712,
      velocity = 7,
      effort = 34),
    dynamics(
      damping = 1.2,
      friction = 1.6));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;forearm_roll&quot; from link &quot;elbow_housing&quot; to link &quot;forearm&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "590719fe-352d", base = "a3993c1be1b7aab9"));
end Forearm_rollParameters;
