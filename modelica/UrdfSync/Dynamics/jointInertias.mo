within UrdfSync.Dynamics;

function jointInertias "Masses and moments of inertia that joints move, one at a time"
  extends Modelica.Icons.Function;

  input Integer jointTree[:, 2]
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  input Real frames[size(jointTree, 1), 15]
    "One row per moving joint, as jointFrames gives them";

  input Real bodies[size(jointTree, 1) + 1, 10]
    "One row per body, as bodyInertias gives them";

  input Real q[size(jointTree, 1)]
    "Positions of the moving joints, in rad or m";

  output Real D[size(jointTree, 1)]
    "Per moving joint: mass if it slides, moment of inertia about its axis if it turns, of all bodies behind it";

protected
  Integer n = size(jointTree, 1);
  Integer i = 1;
  Integer p = 1;
  Real c[size(jointTree, 1) + 1, 10] = bodies;
  Real R[3, 3] = identity(3);
  Real e[3] = zeros(3);
  Real d = 0;
algorithm
  D := zeros(n);
  for k in 1:n loop
    i := n + 1 - k;
    p := jointTree[i, 1];
    e := frames[i, 13:15];
    R := UrdfSync.Dynamics.rotationOf(frames[i, :]);
    if jointTree[i, 2] == 2 then
      D[i] := c[i + 1, 1];
      c[p, :] := c[p, :] + UrdfSync.Dynamics.moved(c[i + 1, :], R, frames[i, 10:12] + R*e*q[i]);
    else
      d := e*([c[i + 1, 5], c[i + 1, 8], c[i + 1, 9]; c[i + 1, 8], c[i + 1, 6], c[i + 1, 10]; c[i + 1, 9], c[i + 1, 10], c[i + 1, 7]]*e);
      D[i] := if d > 1e-13*(c[i + 1, 5] + c[i + 1, 6] + c[i + 1, 7]) then d else 0;
      c[p, :] := c[p, :] + UrdfSync.Dynamics.moved(c[i + 1, :], R*UrdfSync.Dynamics.turn(e, q[i]), frames[i, 10:12]);
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
The diagonal of the mass matrix (Featherstone: Rigid Body Dynamics Algorithms, section 6.2). Where it is zero, the free motion of the joint has no solution;
so what only rounding has left of a moment of inertia is given as zero.
</p>
</html>"));
end jointInertias;
