within ;

package Rig "Robot Rig: links, joints, robot and benches"
  extends UrdfSync.Icons.RobotPackage;

  annotation (
    uses(
      Modelica(version="4.0.0"),
      UrdfSync(version="1.0.0")),
    Documentation(info="<html>
<p>
Made by urdfsync from a URDF. Every file can be edited: urdfsync keeps what you changed, brings everything else up to date, and reports where both changed.
</p>
</html>"));
end Rig;
