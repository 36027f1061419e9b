within Rig.Joints;

record RollParameters "Numbers of continuous joint \"roll\" from link \"palm\" to link \"tool\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "roll",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {1, 0, 0},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = 4,
      effort = 20),
    dynamics(
      damping = 0,
      friction = 0,
      armature = 0.001),
    transmission(
      reduction = 120,
      offset = 0,
      rotorInertia = 0.0001,
      otherReduction = -80));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;roll&quot; from link &quot;palm&quot; to link &quot;tool&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end RollParameters;
