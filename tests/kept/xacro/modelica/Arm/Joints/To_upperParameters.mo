within Arm.Joints;

record To_upperParameters "Numbers of revolute joint \"to_upper\" from link \"base\" to link \"upper\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "to_upper",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 1,
      effort = 10));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;to_upper&quot; from link &quot;base&quot; to link &quot;upper&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "6f33382c-352d", base = "777cf66f168d8196"));
end To_upperParameters;
