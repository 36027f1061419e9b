within Zoo.Menagerie.Joints;

record Lead__screwParameters "Numbers of prismatic joint \"lead-screw\" from link \"upper arm\" to link \"nut\""
  extends UrdfSync.Records.PrismaticJoint(
    name = "lead-screw",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = 0,
      upper = 0.1,
      velocity = 0.1,
      effort = 20),
    mimic(
      multiplier = 0.02,
      offset = 0));

  annotation (Documentation(info="<html>
<p>
Numbers of prismatic joint &quot;lead-screw&quot; from link &quot;upper arm&quot; to link &quot;nut&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end Lead__screwParameters;
