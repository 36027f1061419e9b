within UrdfSync.Dynamics;

function massMatrix "Mass matrix of the moving joints"
  extends Modelica.Icons.Function;

  input Integer jointTree[:, 2]
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  input Real frames[size(jointTree, 1), 15]
    "One row per moving joint, as jointFrames gives them";

  input Real bodies[size(jointTree, 1) + 1, 10]
    "One row per body, as bodyInertias gives them";

  input Real q[size(jointTree, 1)]
    "Positions of the moving joints, in rad or m";

  output Real M[size(jointTree, 1), size(jointTree, 1)]
    "Symmetric; row and column i belong to moving joint i";

protected
  Integer n = size(jointTree, 1);
  Integer j = 1;
  Integer p = 1;
  Real R[size(jointTree, 1), 3, 3] = zeros(size(jointTree, 1), 3, 3);
  Real r[size(jointTree, 1), 3] = zeros(size(jointTree, 1), 3);
  Real c[size(jointTree, 1) + 1, 10] = bodies;
  Real e[3] = zeros(3);
  Real f[3] = zeros(3);
  Real t[3] = zeros(3);
algorithm
  M := zeros(n, n);
  for i in 1:n loop
    e := frames[i, 13:15];
    R[i, :, :] := UrdfSync.Dynamics.rotationOf(frames[i, :]);
    r[i, :] := frames[i, 10:12];
    if jointTree[i, 2] == 2 then
      r[i, :] := r[i, :] + R[i, :, :]*e*q[i];
    else
      R[i, :, :] := R[i, :, :]*UrdfSync.Dynamics.turn(e, q[i]);
    end if;
  end for;
  for i in n:-1:1 loop
    p := jointTree[i, 1];
    c[p, :] := c[p, :] + UrdfSync.Dynamics.moved(c[i + 1, :], R[i, :, :], r[i, :]);
    e := frames[i, 13:15];
    if jointTree[i, 2] == 2 then
      f := c[i + 1, 1]*e;
      t := cross(c[i + 1, 2:4], e);
      M[i, i] := e*f;
    else
      f := cross(e, c[i + 1, 2:4]);
      t := [c[i + 1, 5], c[i + 1, 8], c[i + 1, 9]; c[i + 1, 8], c[i + 1, 6], c[i + 1, 10]; c[i + 1, 9], c[i + 1, 10], c[i + 1, 7]]*e;
      M[i, i] := e*t;
    end if;
    j := i;
    for s in 1:n loop
      if jointTree[j, 1] > 1 then
        f := R[j, :, :]*f;
        t := R[j, :, :]*t + cross(r[j, :], f);
        j := jointTree[j, 1] - 1;
        M[i, j] := frames[j, 13:15]*(if jointTree[j, 2] == 2 then f else t);
        M[j, i] := M[i, j];
      end if;
    end for;
  end for;

  annotation (Documentation(info="<html>
<p>
The composite-rigid-body algorithm (Featherstone: Rigid Body Dynamics Algorithms, section 6.2), for a base at rest. Mimic joints count as joints of their own.
</p>
</html>"));
end massMatrix;
