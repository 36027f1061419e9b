within UrdfSync.Dynamics;

function jacobian "Geometric Jacobian of a link"
  extends Modelica.Icons.Function;

  input Integer jointTree[:, 2]
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  input Real frames[size(jointTree, 1), 15]
    "One row per moving joint, as jointFrames gives them";

  input Integer linkBodies[:]
    "Per link: number of the body that it is part of; 1 is the base";

  input Real links[size(linkBodies, 1), 12]
    "One row per link, as linkFrames gives them";

  input Real q[size(jointTree, 1)]
    "Positions of the moving joints, in rad or m";

  input Integer link = UrdfSync.Dynamics.toolLink(jointTree, linkBodies)
    "Number of the link";

  output Real J[6, size(jointTree, 1)]
    "Velocity of the origin of the link, and below its angular velocity, per speed of each moving joint, resolved in the base frame";

protected
  Integer n = size(jointTree, 1);
  Integer p = 1;
  Integer j = 1;
  Real R[size(jointTree, 1) + 1, 3, 3] = zeros(size(jointTree, 1) + 1, 3, 3);
  Real r[size(jointTree, 1) + 1, 3] = zeros(size(jointTree, 1) + 1, 3);
  Real e[size(jointTree, 1), 3] = zeros(size(jointTree, 1), 3);
  Real Q[3, 3] = identity(3);
  Real o[3] = zeros(3);
algorithm
  J := zeros(6, n);
  R[1, :, :] := identity(3);
  for i in 1:n loop
    p := jointTree[i, 1];
    Q := R[p, :, :]*UrdfSync.Dynamics.rotationOf(frames[i, :]);
    e[i, :] := Q*frames[i, 13:15];
    r[i + 1, :] := r[p, :] + R[p, :, :]*frames[i, 10:12];
    if jointTree[i, 2] == 2 then
      R[i + 1, :, :] := Q;
      r[i + 1, :] := r[i + 1, :] + e[i, :]*q[i];
    else
      R[i + 1, :, :] := Q*UrdfSync.Dynamics.turn(frames[i, 13:15], q[i]);
    end if;
  end for;
  j := linkBodies[link];
  o := r[j, :] + R[j, :, :]*links[link, 10:12];
  for s in 1:n loop
    if j > 1 then
      if jointTree[max(1, j - 1), 2] == 2 then
        J[1:3, max(1, j - 1)] := e[max(1, j - 1), :];
      else
        J[1:3, max(1, j - 1)] := cross(e[max(1, j - 1), :], o - r[j, :]);
        J[4:6, max(1, j - 1)] := e[max(1, j - 1), :];
      end if;
      j := jointTree[max(1, j - 1), 1];
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
A turning joint contributes <code>{e x r, e}</code>, a sliding joint <code>{e, 0}</code> (Siciliano et al.: Robotics, section 3.1.3).
</p>
</html>"));
end jacobian;
