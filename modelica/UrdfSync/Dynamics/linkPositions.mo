within UrdfSync.Dynamics;

function linkPositions "Origin of each link in the body that it is part of"
  extends Modelica.Icons.Function;

  input Integer connectionMatrix[:, 2]
    "One row per joint: {number of the parent link, number of the child link}";

  input Integer linkBodies[:]
    "Per link: number of the body that it is part of; 1 is the base";

  input Modelica.Units.SI.Position jointPositions[:, 3]
    "Per joint, fixed ones included: origin in the frame of the parent link";

  input Real linkRotations[:, 3, 3](each unit = "1")
    "Per link: rotation in its body";

  output Modelica.Units.SI.Position r[size(linkBodies, 1), 3]
    "Per link: origin, resolved in the body";

algorithm
  r := zeros(size(linkBodies, 1), 3);
  for k in 1:size(jointPositions, 1) loop
    if linkBodies[connectionMatrix[k, 2]] == linkBodies[connectionMatrix[k, 1]] then
      r[connectionMatrix[k, 2], :] := r[connectionMatrix[k, 1], :] + linkRotations[connectionMatrix[k, 1], :, :]*jointPositions[k, :];
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
Along the fixed joints of a body <code>r_child = r_parent + R_parent*xyz</code>, with the position of the joint's origin.
</p>
</html>"));
end linkPositions;
