within Zoo.Menagerie.Joints;

record Table_joint_06ab04Parameters "Numbers of planar joint \"table\" from link \"chassis\" to link \"table\""
  extends UrdfSync.Records.PlanarJoint(
    name = "table",
    origin(
      xyz = {0, 0, 0.4},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    translation(
      damping = 4,
      friction = 2),
    rotation(
      damping = 4,
      friction = 2));

  annotation (Documentation(info="<html>
<p>
Numbers of planar joint &quot;table&quot; from link &quot;chassis&quot; to link &quot;table&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end Table_joint_06ab04Parameters;
