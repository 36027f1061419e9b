within Zoo.Menagerie.Joints;

record Pinion_joint_d4c7e8Parameters "Numbers of continuous joint \"pinion\" from link \"l_arm\" to link \"pinion\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "pinion",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = Modelica.Constants.inf,
      effort = Modelica.Constants.inf),
    mimic(
      multiplier = 80,
      offset = 0));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;pinion&quot; from link &quot;l_arm&quot; to link &quot;pinion&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end Pinion_joint_d4c7e8Parameters;
