within UrdfSync.Examples.WheeledRobot;

package Joints "Joints of robot WheeledRobot"
  extends UrdfSync.Icons.JointsPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per joint.
</p>
</html>"));
end Joints;
