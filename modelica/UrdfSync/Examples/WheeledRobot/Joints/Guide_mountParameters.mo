within UrdfSync.Examples.WheeledRobot.Joints;

record Guide_mountParameters "Numbers of fixed joint \"guide_mount\" from link \"base_link\" to link \"column_guide\""
  extends UrdfSync.Records.FixedJoint(
    name = "guide_mount",
    origin(
      xyz = {-0.12, 0, 0.118},
      rpy = {0, 0, 0}));

  annotation (Documentation(info="<html>
<p>
Numbers of fixed joint &quot;guide_mount&quot; from link &quot;base_link&quot; to link &quot;column_guide&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "b4b6837d-352d", base = "d41d99d2d579d90a"));
end Guide_mountParameters;
