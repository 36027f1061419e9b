within UrdfSync.Records;

record Robot "Numbers of a whole robot: what all robots have"
  extends UrdfSync.Icons.Parameters;

  String name = ""
    "Name of the robot in the URDF";

  Modelica.Units.SI.Position standingHeight = 0
    "Height of the root frame above the lowest point of all collision shapes, all joints at their start";

  Integer connectionMatrix[:, 2] = fill(0, 0, 2)
    "One row per joint: {number of the parent link, number of the child link}, counted from 1; link 1 is the root";

  Integer moveableJoints[:, 2] = fill(0, 0, 2)
    "One row per joint that is not fixed: {number of the joint, 1}";

  annotation (Documentation(info="<html>
<p>
The record of a generated robot adds one component per link and per joint. Links and joints are numbered
depth-first from the root, siblings in natural order of their names: joint <code>k</code> leads to link <code>k + 1</code>.
</p>
</html>"));
end Robot;
