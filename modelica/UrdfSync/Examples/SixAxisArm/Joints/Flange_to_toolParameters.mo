within UrdfSync.Examples.SixAxisArm.Joints;

record Flange_to_toolParameters "Numbers of fixed joint \"flange_to_tool\" from link \"mounting_flange\" to link \"tool0\""
  extends UrdfSync.Records.FixedJoint(
    name = "flange_to_tool",
    origin(
      xyz = {0.012, 0, 0},
      rpy = {0, 1.5707963, 0}));

  annotation (Documentation(info="<html>
<p>
Numbers of fixed joint &quot;flange_to_tool&quot; from link &quot;mounting_flange&quot; to link &quot;tool0&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "95f1384f-352d", base = "7d8f6b0a3148db65"));
end Flange_to_toolParameters;
