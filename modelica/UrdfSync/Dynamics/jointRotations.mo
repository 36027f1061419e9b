within UrdfSync.Dynamics;

function jointRotations "Rotation of each moving joint at position zero in the body that carries it"
  extends Modelica.Icons.Function;

  input Integer connectionMatrix[:, 2]
    "One row per joint: {number of the parent link, number of the child link}";

  input Integer linkBodies[:]
    "Per link: number of the body that it is part of; 1 is the base";

  input Integer jointTree[:, 2]
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  input Modelica.Units.SI.Angle jointAngles[:, 3]
    "Per joint, fixed ones included: roll, pitch and yaw in the frame of the parent link";

  input Real linkRotations[:, 3, 3](each unit = "1")
    "Per link: rotation in its body";

  output Real R[size(jointTree, 1), 3, 3](each unit = "1")
    "Per moving joint: v_carrier = R*v_joint";

algorithm
  R := zeros(size(jointTree, 1), 3, 3);
  for k in 1:size(jointAngles, 1) loop
    if linkBodies[connectionMatrix[k, 2]] <> linkBodies[connectionMatrix[k, 1]] then
      R[linkBodies[connectionMatrix[k, 2]] - 1, :, :] := linkRotations[connectionMatrix[k, 1], :, :]*UrdfSync.Functions.rotation(jointAngles[k, :]);
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
Moving joint <code>i</code> moves body <code>i + 1</code>; body 1 is the base. The origin of the joint stands in the frame of its parent link, and that in the carrier:
<code>R = R_link*Rz(yaw)*Ry(pitch)*Rx(roll)</code>.
</p>
</html>"));
end jointRotations;
