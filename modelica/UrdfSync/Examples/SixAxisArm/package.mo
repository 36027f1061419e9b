within UrdfSync.Examples;

package SixAxisArm "Robot SixAxisArm: links, joints, robot and benches"
  extends UrdfSync.Icons.RobotPackage;

  annotation (
    Documentation(info="<html>
<p>
Made by urdfsync from a URDF. <code>SixAxisArmGeneric</code> simulates the robot as <code>UrdfSync.Robots.GenericRobot</code> reads it from <code>SixAxisArmParameters</code>. Every file can be edited: urdfsync keeps what you changed, brings everything else up to date, and reports where both changed.
</p>
</html>"),
    __urdfsync(id = "18d63be1-cedc", base = "f13859f82b37594e"));
end SixAxisArm;
