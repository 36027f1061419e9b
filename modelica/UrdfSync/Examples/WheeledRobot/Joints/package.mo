within UrdfSync.Examples.WheeledRobot;

package Joints "Joints of robot WheeledRobot"
  extends UrdfSync.Icons.JointsPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per joint.
</p>
</html>"),
    __urdfsync(id = "18d63be1-3b89", base = "6d15196e60b9d7c0"));
end Joints;
