within Rig.Joints;

record RackParameters "Numbers of prismatic joint \"rack\" from link \"fork\" to link \"tooth\""
  extends UrdfSync.Records.PrismaticJoint(
    name = "rack",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 1,
      effort = 5),
    mimic(
      multiplier = -1,
      offset = 0.125));

  annotation (Documentation(info="<html>
<p>
Numbers of prismatic joint &quot;rack&quot; from link &quot;fork&quot; to link &quot;tooth&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end RackParameters;
