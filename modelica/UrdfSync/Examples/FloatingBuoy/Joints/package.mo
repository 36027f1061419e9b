within UrdfSync.Examples.FloatingBuoy;

package Joints "Joints of robot FloatingBuoy"
  extends UrdfSync.Icons.JointsPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per joint.
</p>
</html>"),
    __urdfsync(id = "18d63be1-3b89", base = "2782392e8e9f0546"));
end Joints;
