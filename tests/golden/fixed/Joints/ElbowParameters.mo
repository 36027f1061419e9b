within Zoo.Menagerie.Joints;

record ElbowParameters "Numbers of revolute joint \"elbow\" from link \"upper arm\" to link \"L_arm\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "elbow",
    origin(
      xyz = {0.3, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -2,
      upper = 0,
      velocity = 2,
      effort = 80),
    mimic(
      multiplier = -0.5,
      offset = 0.1));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;elbow&quot; from link &quot;upper arm&quot; to link &quot;L_arm&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end ElbowParameters;
