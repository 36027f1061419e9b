within UrdfSync;

package Joints "Joints that stand alone"
  extends UrdfSync.Icons.JointsPackage;

  annotation (Documentation(info="<html>
<p>
Models for robots that are built by hand. They are made from the same templates as the joints of generated robots, which
do not use them: a generated model is a copy of its own, and can be changed alone.
</p>
</html>"));
end Joints;
