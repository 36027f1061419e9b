within Arm.Joints;

record ElbowParameters "Numbers of revolute joint \"elbow\" from link \"base\" to link \"fore\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "elbow",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -1,
      upper = 1,
      velocity = 2,
      effort = 5));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;elbow&quot; from link &quot;base&quot; to link &quot;fore&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "056fd1cc-352d", base = "74d57433681ddfec"));
end ElbowParameters;
