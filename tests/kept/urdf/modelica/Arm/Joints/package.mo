within Arm;

package Joints "Joints of robot Arm"
  extends UrdfSync.Icons.JointsPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per joint.
</p>
</html>"),
    __urdfsync(id = "18d63be1-3b89", base = "1b629d7adeca2fb5"));
end Joints;
