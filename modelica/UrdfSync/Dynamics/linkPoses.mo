within UrdfSync.Dynamics;

function linkPoses "Forward kinematics: where links are"
  extends Modelica.Icons.Function;

  input UrdfSync.Records.RigidBodyTree tree
    "Bodies and joints: the component tree of the robot's record";

  input UrdfSync.Types.JointPosition q[:]
    "Positions of the moving joints";

  input Integer links[:]
    "Numbers of the links";

  input Real R_base[3, 3](each unit = "1") = identity(3)
    "Rotation of the base frame in the frame of reference: v_reference = R_base*v_base";

  input Modelica.Units.SI.Position r_base[3] = zeros(3)
    "Origin of the base frame in the frame of reference";

  output Modelica.Units.SI.Position r_0[size(links, 1), 3]
    "Per link: origin, resolved in the frame of reference";

  output Real R_0[size(links, 1), 3, 3](each unit = "1")
    "Per link: v_reference = R_0*v_link";

protected
  Real R[size(q, 1) + 1, 3, 3](each unit = "1") = zeros(size(q, 1) + 1, 3, 3);
  Modelica.Units.SI.Position r[size(q, 1) + 1, 3] = zeros(size(q, 1) + 1, 3);
  Integer p = 1;
algorithm
  R[1, :, :] := R_base;
  r[1, :] := r_base;
  // rumoca refuses a loop over an empty table that reads it outside of a condition: hence the condition, which always holds.
  for i in 1:size(q, 1) loop
    if tree.jointTree[i, 2] > 0 then
      p := tree.jointTree[i, 1];
      R[i + 1, :, :] := R[p, :, :]*tree.jointRotations[i, :, :]*UrdfSync.Dynamics.turn(tree.turnAxes[i, :], if tree.jointTree[i, 2] == 1 then q[i] else 0);
      r[i + 1, :] := r[p, :] + R[p, :, :]*(tree.jointOrigins[i, :] + tree.jointRotations[i, :, :]*tree.slideAxes[i, :]*q[i]);
    end if;
  end for;
  r_0 := zeros(size(links, 1), 3);
  R_0 := zeros(size(links, 1), 3, 3);
  for k in 1:size(links, 1) loop
    p := tree.linkBodies[links[k]];
    r_0[k, :] := r[p, :] + R[p, :, :]*tree.linkPositions[links[k], :];
    R_0[k, :, :] := R[p, :, :]*tree.linkRotations[links[k], :, :];
  end for;

  annotation (Documentation(info="<html>
<p>
From the base outwards, body by body, then each link in its body. Body <code>i + 1</code> is in the body <code>p</code> that carries it at
</p>
<pre>
R[i + 1] = R[p]*R_joint*turn(e_t, q)
r[i + 1] = r[p] + R[p]*(r_joint + R_joint*e_s*q)
</pre>
<p>
(Featherstone: Rigid Body Dynamics Algorithms, 2008, section 4.3): a joint that turns has <code>e_s = 0</code>, one that slides does not turn.
</p>
</html>"));
end linkPoses;
