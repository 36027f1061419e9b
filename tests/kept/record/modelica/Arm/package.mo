within ;

package Arm "Robot Arm in one record"
  extends UrdfSync.Icons.RobotPackage;

  annotation (
    uses(
      Modelica(version="4.0.0"),
      UrdfSync(version="1.0.0")),
    Documentation(info="<html>
<p>
Made by urdfsync from a URDF. <code>ArmGeneric</code> simulates the robot as <code>UrdfSync.Robots.GenericRobot</code> reads it from <code>ArmParameters</code>. Every file can be edited: urdfsync keeps what you changed, brings everything else up to date, and reports where both changed.
</p>
</html>"),
    __urdfsync(id = "18d63be1-cedc", base = "7ce862d75f665d48"));
end Arm;
