within Zoo.Mill.Joints;

record HookParameters "Numbers of ball joint \"hook\" from link \"ground\" to link \"bob\""
  extends UrdfSync.Records.BallJoint(
    name = "hook",
    origin(
      xyz = {0, 0, -0.5},
      rpy = {0, 0, 0}),
    damping = 0.125);

  annotation (Documentation(info="<html>
<p>
Numbers of ball joint &quot;hook&quot; from link &quot;ground&quot; to link &quot;bob&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end HookParameters;
