within Rig.Joints;

record FlexParameters "Numbers of revolute joint \"flex\" from link \"head\" to link \"palm\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "flex",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 4,
      effort = 30),
    transmission(
      reduction = 90,
      offset = 0,
      rotorInertia = 0.0002,
      otherReduction = 135));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;flex&quot; from link &quot;head&quot; to link &quot;palm&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end FlexParameters;
