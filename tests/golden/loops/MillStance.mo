within Zoo.Mill;

record MillStance "How robot Mill stands at the beginning"
  extends UrdfSync.Records.Stance;

  annotation (Documentation(info="<html>
<p>
The height at which the lowest collision shape of the robot touches the ground while its joints are at their start positions. It may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end MillStance;
