within Zoo.Menagerie.Joints;

record Held_turn_a231f5Parameters "Numbers of revolute joint \"held turn\" from link \"name\" to link \"time\""
  extends UrdfSync.Records.RevoluteJoint(
    name = "held turn",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -1,
      upper = 1,
      velocity = 1,
      effort = 1),
    mimic(
      multiplier = 1,
      offset = 0.25));

  annotation (Documentation(info="<html>
<p>
Numbers of revolute joint &quot;held turn&quot; from link &quot;name&quot; to link &quot;time&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end Held_turn_a231f5Parameters;
