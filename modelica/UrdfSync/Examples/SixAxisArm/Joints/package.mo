within UrdfSync.Examples.SixAxisArm;

package Joints "Joints of robot SixAxisArm"
  extends UrdfSync.Icons.JointsPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per joint.
</p>
</html>"),
    __urdfsync(id = "18d63be1-3b89", base = "3d2c7bc7aecdd665"));
end Joints;
