within UrdfSync.Examples;

package PlanarPlatform "Robot PlanarPlatform: links, joints, robot and benches"
  extends UrdfSync.Icons.RobotPackage;

  annotation (
    Documentation(info="<html>
<p>
Made by urdfsync from a URDF. Every file can be edited: urdfsync keeps what you changed, brings everything else up to date, and reports where both changed.
</p>
</html>"),
    __urdfsync(id = "18d63be1-cedc", base = "233199bc39d27e94"));
end PlanarPlatform;
