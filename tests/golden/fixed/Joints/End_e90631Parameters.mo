within Zoo.Menagerie.Joints;

record End_e90631Parameters "Numbers of prismatic joint \"end\" from link \"l_arm\" to link \"end\""
  extends UrdfSync.Records.PrismaticJoint(
    name = "end",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 1,
      effort = 5),
    dynamics(
      damping = 2,
      friction = 0.5),
    mimic(
      multiplier = 1,
      offset = 0));

  annotation (Documentation(info="<html>
<p>
Numbers of prismatic joint &quot;end&quot; from link &quot;l_arm&quot; to link &quot;end&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end End_e90631Parameters;
