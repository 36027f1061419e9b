within Arm.Joints;

record ElbowParameters "Numbers of continuous joint \"elbow\" from link \"upper\" to link \"fore\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "elbow",
    origin(
      xyz = {0, 0, 0.4},
      rpy = {0, 0, 0.523598775598299}),
    axis = {0, 1, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf),
    dynamics(
      damping = 0,
      friction = 0,
      armature = 0.1,
      springStiffness = 4));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;elbow&quot; from link &quot;upper&quot; to link &quot;fore&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "056fd1cc-352d", base = "49cb77d5b303c87e"));
end ElbowParameters;
