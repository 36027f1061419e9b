within Rig.Joints;

record TiltParameters "Numbers of revolute joint \"tilt\" from link \"plate\" to link \"head\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "tilt",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -1,
      upper = 1.5,
      velocity = 3,
      effort = 12,
      acceleration = 6),
    dynamics(
      damping = 0.25,
      friction = 0.5,
      armature = 0.002),
    transmission(
      reduction = 50,
      offset = 0,
      rotorInertia = 0.0001));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;tilt&quot; from link &quot;plate&quot; to link &quot;head&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end TiltParameters;
