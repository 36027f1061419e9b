within UrdfSync.Dynamics;

function linkRotations "Rotation of each link in the body that it is part of"
  extends Modelica.Icons.Function;

  input Integer connectionMatrix[:, 2]
    "One row per joint: {number of the parent link, number of the child link}";

  input Integer linkBodies[:]
    "Per link: number of the body that it is part of; 1 is the base";

  input Modelica.Units.SI.Angle jointAngles[:, 3]
    "Per joint, fixed ones included: roll, pitch and yaw in the frame of the parent link";

  output Real R[size(linkBodies, 1), 3, 3](each unit = "1")
    "Per link: v_body = R*v_link";

algorithm
  R := zeros(size(linkBodies, 1), 3, 3);
  for k in 1:size(linkBodies, 1) loop
    R[k, :, :] := identity(3);
  end for;
  for k in 1:size(jointAngles, 1) loop
    if linkBodies[connectionMatrix[k, 2]] == linkBodies[connectionMatrix[k, 1]] then
      R[connectionMatrix[k, 2], :, :] := R[connectionMatrix[k, 1], :, :]*UrdfSync.Functions.rotation(jointAngles[k, :]);
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
A body is what moves as one: a link behind a moving joint, and all links that fixed joints connect to it. Its frame is that of its first link. Along the fixed joints
of a body
</p>
<pre>R_child = R_parent*Rz(yaw)*Ry(pitch)*Rx(roll)</pre>
<p>
with the angles of the joint's origin (Craig: Introduction to Robotics, section 2.3).
</p>
</html>"));
end linkRotations;
