within Rig.Joints;

record LiftParameters "Numbers of prismatic joint \"lift\" from link \"trunk\" to link \"fork\""
  extends UrdfSync.Records.PrismaticJoint(
    name = "lift",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    limits(
      lower = 0,
      upper = 0.75,
      velocity = 0.5,
      effort = 500,
      acceleration = 2),
    dynamics(
      damping = 40,
      friction = 8,
      armature = 0.25),
    transmission(
      reduction = 400,
      offset = 0,
      rotorInertia = 1e-05));

  annotation (Documentation(info="<html>
<p>
Numbers of prismatic joint &quot;lift&quot; from link &quot;trunk&quot; to link &quot;fork&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end LiftParameters;
