within UrdfSync.Dynamics;

function massMatrix "Mass matrix of the moving joints"
  extends Modelica.Icons.Function;

  input UrdfSync.Records.RigidBodyTree tree
    "Bodies and joints: the component tree of the robot's record";

  input UrdfSync.Types.JointPosition q[:]
    "Positions of the moving joints";

  output Modelica.Units.SI.MomentOfInertia M[size(q, 1), size(q, 1)](each min = -Modelica.Constants.inf)
    "Symmetric; row and column i belong to moving joint i";

protected
  Integer p = 1;
  Integer b = 1;
  Real R[size(q, 1), 3, 3](each unit = "1") = zeros(size(q, 1), 3, 3);
  Modelica.Units.SI.Position r[size(q, 1), 3] = zeros(size(q, 1), 3);
  Modelica.Units.SI.Mass m[size(q, 1) + 1] = tree.bodyMasses;
  Real h[size(q, 1) + 1, 3](each unit = "kg.m") = tree.bodyMoments;
  Modelica.Units.SI.MomentOfInertia J[size(q, 1) + 1, 3, 3](each min = -Modelica.Constants.inf) = tree.bodyInertias;
  Real f[3](each unit = "kg.m") = zeros(3);
  Modelica.Units.SI.MomentOfInertia t[3](each min = -Modelica.Constants.inf) = zeros(3);
algorithm
  for i in 1:size(q, 1) loop
    R[i, :, :] := tree.jointRotations[i, :, :]*UrdfSync.Dynamics.turn(tree.turnAxes[i, :], if tree.jointTree[i, 2] == 1 then q[i] else 0);
    r[i, :] := tree.jointOrigins[i, :] + tree.jointRotations[i, :, :]*tree.slideAxes[i, :]*q[i];
  end for;
  M := zeros(size(q, 1), size(q, 1));
  for i in size(q, 1):-1:1 loop
    p := tree.jointTree[i, 1];
    J[p, :, :] := J[p, :, :] + UrdfSync.Dynamics.movedInertia(m[i + 1], h[i + 1, :], J[i + 1, :, :], R[i, :, :], r[i, :]);
    h[p, :] := h[p, :] + R[i, :, :]*h[i + 1, :] + m[i + 1]*r[i, :];
    m[p] := m[p] + m[i + 1];
    f := cross(tree.turnAxes[i, :], h[i + 1, :]) + m[i + 1]*tree.slideAxes[i, :];
    t := J[i + 1, :, :]*tree.turnAxes[i, :] + cross(h[i + 1, :], tree.slideAxes[i, :]);
    M[i, i] := tree.turnAxes[i, :]*t + tree.slideAxes[i, :]*f + tree.driveInertias[i];
    b := i + 1;
    for j in size(q, 1):-1:1 loop
      if b == j + 1 then
        if j < i then
          M[i, j] := tree.turnAxes[j, :]*t + tree.slideAxes[j, :]*f;
          M[j, i] := M[i, j];
        end if;
        f := R[j, :, :]*f;
        t := R[j, :, :]*t + cross(r[j, :], f);
        b := tree.jointTree[j, 1];
      end if;
    end for;
  end for;

  annotation (Documentation(info="<html>
<p>
The composite-rigid-body algorithm (Featherstone: Rigid Body Dynamics Algorithms, 2008, section 6.2), for a base at rest. <code>m</code>, <code>h</code> and <code>J</code> of all that
joint <code>i</code> moves are added up from the leaves inwards. Per acceleration of joint <code>i</code> that needs, at the origin of its body,
</p>
<pre>
f = e_t x h + m*e_s        kg.m
t = J*e_t + h x e_s        kg.m2
</pre>
<p>
and <code>M[i, j] = e_t[j]*t + e_s[j]*f</code> for joint <code>j = i</code> and all joints before it, to whose bodies <code>f</code> and <code>t</code> are moved.
What a drive adds to the inertia of its joint stands on the diagonal only. Mimic joints count as joints of their own. All elements are in kg.m2: see <a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a>.
</p>
</html>"));
end massMatrix;
