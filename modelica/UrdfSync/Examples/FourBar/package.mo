within UrdfSync.Examples;

package FourBar "Robot FourBar: links, joints, robot and benches"
  extends UrdfSync.Icons.RobotPackage;

  annotation (
    Documentation(info="<html>
<p>
Made by urdfsync from a URDF. Every file can be edited: urdfsync keeps what you changed, brings everything else up to date, and reports where both changed.
</p>
</html>"));
end FourBar;
