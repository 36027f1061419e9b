within UrdfSync.Dynamics;

function jointOrigins "Origin of each moving joint at position zero in the body that carries it"
  extends Modelica.Icons.Function;

  input Integer connectionMatrix[:, 2]
    "One row per joint: {number of the parent link, number of the child link}";

  input Integer linkBodies[:]
    "Per link: number of the body that it is part of; 1 is the base";

  input Integer jointTree[:, 2]
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  input Modelica.Units.SI.Position jointPositions[:, 3]
    "Per joint, fixed ones included: origin in the frame of the parent link";

  input Real linkRotations[:, 3, 3](each unit = "1")
    "Per link: rotation in its body";

  input Modelica.Units.SI.Position linkPositions[:, 3]
    "Per link: origin in its body";

  output Modelica.Units.SI.Position r[size(jointTree, 1), 3]
    "Per moving joint: origin, resolved in the carrier";

algorithm
  r := zeros(size(jointTree, 1), 3);
  for k in 1:size(jointPositions, 1) loop
    if linkBodies[connectionMatrix[k, 2]] <> linkBodies[connectionMatrix[k, 1]] then
      r[linkBodies[connectionMatrix[k, 2]] - 1, :] := linkPositions[connectionMatrix[k, 1], :] + linkRotations[connectionMatrix[k, 1], :, :]*jointPositions[k, :];
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
<code>r = r_link + R_link*xyz</code>: the origin of the joint stands in the frame of its parent link.
</p>
</html>"));
end jointOrigins;
