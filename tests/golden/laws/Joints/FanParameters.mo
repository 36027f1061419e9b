within Rig.Joints;

record FanParameters "Numbers of revolute joint \"fan\" from link \"trunk\" to link \"blade\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "fan",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 2,
      effort = 3),
    mimic(
      multiplier = 0.5,
      offset = 0));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;fan&quot; from link &quot;trunk&quot; to link &quot;blade&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end FanParameters;
