within UrdfSync.Examples.WheeledRobot;

record WheeledRobotStance "How robot WheeledRobot stands at the beginning"
  extends UrdfSync.Records.Stance(
    height = 0.100000000536);

  annotation (Documentation(info="<html>
<p>
The height at which the lowest collision shape of the robot touches the ground while its joints are at their start positions. It may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "18d63be1-edae", base = "b51c8e6fa8a1cad5"));
end WheeledRobotStance;
