within UrdfSync.Examples.SixAxisArm.Joints;

record Grasp_frameParameters "Numbers of fixed joint \"grasp_frame\" from link \"gripper_body\" to link \"grasp_point\""
  extends UrdfSync.Records.FixedJoint(
    name = "grasp_frame",
    origin(
      xyz = {0, 0, 0.151},
      rpy = {0, 0, 0}));

  annotation (Documentation(info="<html>
<p>
Numbers of fixed joint &quot;grasp_frame&quot; from link &quot;gripper_body&quot; to link &quot;grasp_point&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "e9caeb11-352d", base = "384c4ac69dc3a0ca"));
end Grasp_frameParameters;
