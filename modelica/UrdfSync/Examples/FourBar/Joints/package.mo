within UrdfSync.Examples.FourBar;

package Joints "Joints of robot FourBar"
  extends UrdfSync.Icons.JointsPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per joint.
</p>
</html>"),
    __urdfsync(id = "18d63be1-3b89", base = "56eeb9212b1d6d4a"));
end Joints;
