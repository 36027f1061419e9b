within UrdfSync.Examples.SixAxisArm.Joints;

record Gripper_mountParameters "Numbers of fixed joint \"gripper_mount\" from link \"tool0\" to link \"gripper_body\""
  extends UrdfSync.Records.FixedJoint(
    name = "gripper_mount",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}));

  annotation (Documentation(info="<html>
<p>
Numbers of fixed joint &quot;gripper_mount&quot; from link &quot;tool0&quot; to link &quot;gripper_body&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "b3f890c5-352d", base = "ab990e054df7d82f"));
end Gripper_mountParameters;
