within UrdfSync.Dynamics;

function jointFrames "Frame of each moving joint at position zero, and its axis"
  extends Modelica.Icons.Function;

  input Integer connectionMatrix[:, 2]
    "One row per joint: {number of the parent link, number of the child link}";

  input Integer linkBodies[:]
    "Per link: number of the body that it is part of; 1 is the base";

  input Modelica.Units.SI.Position jointPositions[:, 3]
    "Per joint: origin in the frame of the parent link";

  input Modelica.Units.SI.Angle jointAngles[size(jointPositions, 1), 3]
    "Per joint: roll, pitch and yaw in the frame of the parent link";

  input Real jointAxes[:, 3](each unit = "1")
    "Per moving joint: axis in the joint frame";

  output Real frames[size(jointAxes, 1), 15]
    "One row per moving joint: {rotation matrix by rows and position in the body that carries it, unit vector along the axis in the joint frame}";

protected
  Real links[size(linkBodies, 1), 12] = UrdfSync.Dynamics.linkFrames(connectionMatrix, linkBodies, jointPositions, jointAngles);
  Integer i = 0;
algorithm
  frames := zeros(size(jointAxes, 1), 15);
  for k in 1:size(jointPositions, 1) loop
    if linkBodies[connectionMatrix[k, 2]] <> linkBodies[connectionMatrix[k, 1]] then
      i := linkBodies[connectionMatrix[k, 2]] - 1;
      frames[i, 1:12] := UrdfSync.Dynamics.compose(links[connectionMatrix[k, 1], :], jointPositions[k, :], jointAngles[k, :]);
      frames[i, 13:15] := jointAxes[i, :]/sqrt(jointAxes[i, :]*jointAxes[i, :]);
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
Moving joint <code>i</code> moves body <code>i + 1</code>; body 1 is the base. Axes of any length are taken, as the joints of the Modelica Standard Library take them.
</p>
</html>"));
end jointFrames;
