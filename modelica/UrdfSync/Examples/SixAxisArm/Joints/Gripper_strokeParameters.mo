within UrdfSync.Examples.SixAxisArm.Joints;

record Gripper_strokeParameters "Numbers of prismatic joint \"gripper_stroke\" from link \"gripper_body\" to link \"finger_left\""
  extends UrdfSync.Records.PrismaticJoint(
    name = "gripper_stroke",
    origin(
      xyz = {0, 0, 0.074},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = 0,
      upper = 0.035,
      velocity = 0.12,
      effort = 140),
    dynamics(
      damping = 25,
      friction = 5));

  annotation (Documentation(info="<html>
<p>
Numbers of prismatic joint &quot;gripper_stroke&quot; from link &quot;gripper_body&quot; to link &quot;finger_left&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "7b7b6b78-352d", base = "54ddaae3eacca9e6"));
end Gripper_strokeParameters;
