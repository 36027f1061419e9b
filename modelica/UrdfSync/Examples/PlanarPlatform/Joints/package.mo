within UrdfSync.Examples.PlanarPlatform;

package Joints "Joints of robot PlanarPlatform"
  extends UrdfSync.Icons.JointsPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per joint.
</p>
</html>"),
    __urdfsync(id = "18d63be1-3b89", base = "0c7fe680d596a17e"));
end Joints;
