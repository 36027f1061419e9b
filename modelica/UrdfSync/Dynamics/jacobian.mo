within UrdfSync.Dynamics;

function jacobian "Geometric Jacobian of a link"
  extends Modelica.Icons.Function;

  input UrdfSync.Records.RigidBodyTree tree
    "Bodies and joints: the component tree of the robot's record";

  input UrdfSync.Types.JointPosition q[:]
    "Positions of the moving joints";

  input Integer link = UrdfSync.Dynamics.toolLink(tree.jointTree, tree.linkBodies)
    "Number of the link";

  output Real J[6, size(q, 1)]
    "Rows 1 to 3: velocity of the origin of the link in m/s, rows 4 to 6: its angular velocity in rad/s, per velocity of each moving joint, resolved in the base frame";

protected
  Integer p = 1;
  Integer b = 1;
  Real R[size(q, 1) + 1, 3, 3](each unit = "1") = zeros(size(q, 1) + 1, 3, 3);
  Modelica.Units.SI.Position r[size(q, 1) + 1, 3] = zeros(size(q, 1) + 1, 3);
  Real e_t[size(q, 1), 3](each unit = "1") = zeros(size(q, 1), 3);
  Modelica.Units.SI.Position e_s[size(q, 1), 3] = zeros(size(q, 1), 3);
  Real Q[3, 3](each unit = "1") = identity(3);
  Modelica.Units.SI.Position o[3] = zeros(3);
algorithm
  J := zeros(6, size(q, 1));
  R[1, :, :] := identity(3);
  for i in 1:size(q, 1) loop
    p := tree.jointTree[i, 1];
    Q := R[p, :, :]*tree.jointRotations[i, :, :];
    e_t[i, :] := Q*tree.turnAxes[i, :];
    e_s[i, :] := Q*tree.slideAxes[i, :];
    R[i + 1, :, :] := R[p, :, :]*tree.jointRotations[i, :, :]*UrdfSync.Dynamics.turn(tree.turnAxes[i, :], if tree.jointTree[i, 2] == 1 then q[i] else 0);
    r[i + 1, :] := r[p, :] + R[p, :, :]*tree.jointOrigins[i, :] + e_s[i, :]*q[i];
  end for;
  b := tree.linkBodies[link];
  o := r[b, :] + R[b, :, :]*tree.linkPositions[link, :];
  for i in size(q, 1):-1:1 loop
    if b == i + 1 then
      J[1:3, i] := cross(e_t[i, :], o - r[b, :]) + e_s[i, :];
      J[4:6, i] := e_t[i, :];
      b := tree.jointTree[i, 1];
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
</p>
<pre>{v, w} = J*der(q)</pre>
<p>
A joint that turns contributes the column <code>{e_t x (o - r), e_t}</code>, one that slides <code>{e_s, 0}</code>, with the origin <code>r</code> of the body that the joint moves and
the origin <code>o</code> of the link (Siciliano et al.: Robotics, 2009, section 3.1.3). Joints that do not carry the link have a column of zeros. The upper rows are in m,
the lower ones without unit. The columns of followers are their own: a leader moves the link by its column plus multiplier times the follower's one.
</p>
</html>"));
end jacobian;
