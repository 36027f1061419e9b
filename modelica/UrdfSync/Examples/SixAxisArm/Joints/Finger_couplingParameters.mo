within UrdfSync.Examples.SixAxisArm.Joints;

record Finger_couplingParameters "Numbers of prismatic joint \"finger_coupling\" from link \"gripper_body\" to link \"finger_right\""
  extends UrdfSync.Records.PrismaticJoint(
    name = "finger_coupling",
    origin(
      xyz = {0, 0, 0.074},
      rpy = {0, 0, 3.1415927}),
    axis = {1, 0, 0},
    limits(
      lower = 0,
      upper = 0.035,
      velocity = 0.12,
      effort = 140),
    dynamics(
      damping = 25,
      friction = 5),
    mimic(
      multiplier = 1,
      offset = 0));

  annotation (Documentation(info="<html>
<p>
Numbers of prismatic joint &quot;finger_coupling&quot; from link &quot;gripper_body&quot; to link &quot;finger_right&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "2301de4d-352d", base = "7f5d6a4e1d6cf814"));
end Finger_couplingParameters;
