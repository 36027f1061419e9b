within UrdfSync.Dynamics;

function jointInertias "Moments of inertia that joints move, one at a time"
  extends Modelica.Icons.Function;

  input UrdfSync.Records.RigidBodyTree tree
    "Bodies and joints: the component tree of the robot's record";

  input UrdfSync.Types.JointPosition q[:]
    "Positions of the moving joints";

  output Modelica.Units.SI.MomentOfInertia D[size(q, 1)]
    "Per moving joint: that of all bodies behind it about its axis, and of its drive; where it slides their mass, times the square of unitLength";

protected
  Integer p = 1;
  Real R[3, 3](each unit = "1") = identity(3);
  Modelica.Units.SI.Position r[3] = zeros(3);
  Modelica.Units.SI.Mass m[size(q, 1) + 1] = tree.bodyMasses;
  Real h[size(q, 1) + 1, 3](each unit = "kg.m") = tree.bodyMoments;
  Modelica.Units.SI.MomentOfInertia J[size(q, 1) + 1, 3, 3](each min = -Modelica.Constants.inf) = tree.bodyInertias;
algorithm
  D := zeros(size(q, 1));
  for i in size(q, 1):-1:1 loop
    p := tree.jointTree[i, 1];
    R := tree.jointRotations[i, :, :]*UrdfSync.Dynamics.turn(tree.turnAxes[i, :], if tree.jointTree[i, 2] == 1 then q[i] else 0);
    r := tree.jointOrigins[i, :] + tree.jointRotations[i, :, :]*tree.slideAxes[i, :]*q[i];
    D[i] := tree.turnAxes[i, :]*(J[i + 1, :, :]*tree.turnAxes[i, :]) + m[i + 1]*(tree.slideAxes[i, :]*tree.slideAxes[i, :]);
    if tree.jointTree[i, 2] == 1 and D[i] <= 1e-13*(J[i + 1, 1, 1] + J[i + 1, 2, 2] + J[i + 1, 3, 3]) then
      D[i] := 0;
    end if;
    D[i] := D[i] + tree.driveInertias[i];
    J[p, :, :] := J[p, :, :] + UrdfSync.Dynamics.movedInertia(m[i + 1], h[i + 1, :], J[i + 1, :, :], R, r);
    h[p, :] := h[p, :] + R*h[i + 1, :] + m[i + 1]*r;
    m[p] := m[p] + m[i + 1];
  end for;

  annotation (Documentation(info="<html>
<p>
The diagonal of the mass matrix, <code>e_t*J*e_t + m*e_s*e_s + driveInertias</code> (Featherstone: Rigid Body Dynamics Algorithms, 2008, section 6.2), with <code>m</code> and <code>J</code> of
all that the joint moves. Where it is zero, the free motion of the joint has no solution;
so what only rounding has left of a moment of inertia is given as zero.
</p>
</html>"));
end jointInertias;
