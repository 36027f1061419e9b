within Rig.Joints;

record WaistParameters "Numbers of continuous joint \"waist\" from link \"base\" to link \"trunk\""
  extends UrdfSync.Records.ContinuousJoint(
    name = "waist",
    origin(
      xyz = {0, 0, 0.5},
      rpy = {0.1, 0.2, 0.3}),
    axis = {0, 0, 1},
    limits(
      lower = -Modelica.Constants.inf,
      upper = Modelica.Constants.inf,
      velocity = 2,
      effort = 90,
      acceleration = 5,
      deceleration = 7,
      jerk = 30),
    dynamics(
      damping = 0.5,
      friction = 1.25,
      armature = 0.01),
    transmission(
      reduction = 100,
      offset = 0.25,
      rotorInertia = 0.0002));

  annotation (Documentation(info="<html>
<p>
Numbers of continuous joint &quot;waist&quot; from link &quot;base&quot; to link &quot;trunk&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end WaistParameters;
