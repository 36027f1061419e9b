within ;

package Arm "Robot Arm: links, joints, robot and benches"
  extends UrdfSync.Icons.RobotPackage;

  annotation (
    uses(
      Modelica(version="4.0.0"),
      UrdfSync(version="1.0.0")),
    Documentation(info="<html>
<p>
Made by urdfsync from a URDF. Every file can be edited: urdfsync keeps what you changed, brings everything else up to date, and reports where both changed.
</p>
</html>"),
    __urdfsync(id = "18d63be1-cedc", base = "46f81a04b926f259"));
end Arm;
