within UrdfSync.Examples;

package WheeledRobot "Robot WheeledRobot: links, joints, robot and benches"
  extends UrdfSync.Icons.RobotPackage;

  annotation (
    Documentation(info="<html>
<p>
Made by urdfsync from a URDF. <code>WheeledRobotGeneric</code> simulates the robot as <code>UrdfSync.Robots.GenericRobot</code> reads it from <code>WheeledRobotParameters</code>. Every file can be edited: urdfsync keeps what you changed, brings everything else up to date, and reports where both changed.
</p>
</html>"),
    __urdfsync(id = "18d63be1-cedc", base = "e35aa43fd97091e6"));
end WheeledRobot;
