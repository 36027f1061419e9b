within Arm.Joints;

record ShoulderParameters "Numbers of revolute joint \"shoulder\" from link \"world\" to link \"upper\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "shoulder",
    origin(
      xyz = {0, 0, 0.5},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -1.5,
      upper = 1.5,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf),
    dynamics(
      damping = 2,
      friction = 0));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;shoulder&quot; from link &quot;world&quot; to link &quot;upper&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "5cd8ca66-352d", base = "951b20560715860c"));
end ShoulderParameters;
