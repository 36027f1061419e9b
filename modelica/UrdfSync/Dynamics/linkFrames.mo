within UrdfSync.Dynamics;

function linkFrames "Frame of each link in the body that it is part of"
  extends Modelica.Icons.Function;

  input Integer connectionMatrix[:, 2]
    "One row per joint: {number of the parent link, number of the child link}";

  input Integer linkBodies[:]
    "Per link: number of the body that it is part of; 1 is the base";

  input Modelica.Units.SI.Position jointPositions[:, 3]
    "Per joint: origin in the frame of the parent link";

  input Modelica.Units.SI.Angle jointAngles[size(jointPositions, 1), 3]
    "Per joint: roll, pitch and yaw in the frame of the parent link";

  output Real frames[size(linkBodies, 1), 12]
    "One row per link: {rotation matrix by rows, position}";

algorithm
  frames := zeros(size(linkBodies, 1), 12);
  for k in 1:size(linkBodies, 1) loop
    frames[k, :] := {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
  end for;
  for k in 1:size(jointPositions, 1) loop
    if linkBodies[connectionMatrix[k, 2]] == linkBodies[connectionMatrix[k, 1]] then
      frames[connectionMatrix[k, 2], :] := UrdfSync.Dynamics.compose(frames[connectionMatrix[k, 1], :], jointPositions[k, :], jointAngles[k, :]);
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
A body is what moves as one: a link behind a moving joint, and all links that fixed joints connect to it. Its frame is that of its first link.
</p>
</html>"));
end linkFrames;
