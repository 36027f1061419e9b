within Rig.Joints;

record PushParameters "Numbers of prismatic joint \"push\" from link \"fork\" to link \"plate\""
  extends UrdfSync.Records.PrismaticJoint(
    name = "push",
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    axis = {0, 1, 0},
    limits(
      lower = -0.25,
      upper = 0.25,
      velocity = 0.25,
      effort = 50),
    dynamics(
      damping = 10,
      friction = 4,
      armature = 0.5));

  annotation (Documentation(info="<html>
<p>
Numbers of prismatic joint &quot;push&quot; from link &quot;fork&quot; to link &quot;plate&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end PushParameters;
