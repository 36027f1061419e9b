within UrdfSync.Examples;

package FloatingBuoy "Robot FloatingBuoy: links, joints, robot and benches"
  extends UrdfSync.Icons.RobotPackage;

  annotation (
    Documentation(info="<html>
<p>
Made by urdfsync from a URDF. Every file can be edited: urdfsync keeps what you changed, brings everything else up to date, and reports where both changed.
</p>
</html>"),
    __urdfsync(id = "18d63be1-cedc", base = "4a723c582cb5cc9c"));
end FloatingBuoy;
