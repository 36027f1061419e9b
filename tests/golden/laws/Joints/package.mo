within Rig;

package Joints "Joints of robot Rig"
  extends UrdfSync.Icons.JointsPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per joint.
</p>
</html>"));
end Joints;
