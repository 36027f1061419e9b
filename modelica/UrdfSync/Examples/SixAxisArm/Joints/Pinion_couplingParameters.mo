within UrdfSync.Examples.SixAxisArm.Joints;

record Pinion_couplingParameters "Numbers of revolute joint \"pinion_coupling\" from link \"gripper_body\" to link \"drive_pinion\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "pinion_coupling",
    origin(
      xyz = {0, 0, 0.074},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -0.05,
      upper = 2.85,
      velocity = 9.6,
      effort = 1.75),
    dynamics(
      damping = 0.0005,
      friction = 0.005),
    mimic(
      multiplier = 80,
      offset = 0));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;pinion_coupling&quot; from link &quot;gripper_body&quot; to link &quot;drive_pinion&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "8efc0703-352d", base = "3d09f05be8935554"));
end Pinion_couplingParameters;
