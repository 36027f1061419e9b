within Zoo.Menagerie.Joints;

record Held_slide_856a5aParameters "Numbers of prismatic joint \"held slide\" from link \"name\" to link \"Gelenk_ä\""
  extends UrdfSync.Records.PrismaticJoint(
    name = "held slide",
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
      offset = 0.125));

  annotation (Documentation(info="<html>
<p>
Numbers of prismatic joint &quot;held slide&quot; from link &quot;name&quot; to link &quot;Gelenk_ä&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end Held_slide_856a5aParameters;
