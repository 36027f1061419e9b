within Rig;

record RigStance "How robot Rig stands at the beginning"
  extends UrdfSync.Records.Stance(
    height = 0.249);

  annotation (Documentation(info="<html>
<p>
The height at which the lowest collision shape of the robot touches the ground while its joints are at their start positions. It may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end RigStance;
