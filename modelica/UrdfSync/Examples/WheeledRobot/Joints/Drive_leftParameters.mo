within UrdfSync.Examples.WheeledRobot.Joints;

record Drive_leftParameters "Numbers of continuous joint \"drive_left\" from link \"base_link\" to link \"wheel_left\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "drive_left",
    origin(
      xyz = {0, 0.205, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = 15,
      effort = 14),
    dynamics(
      damping = 0.06,
      friction = 0.25),
    transmission(
      reduction = 24,
      offset = 0));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;drive_left&quot; from link &quot;base_link&quot; to link &quot;wheel_left&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "3c96cf6d-352d", base = "d329aa23c66d5bd8"));
end Drive_leftParameters;
