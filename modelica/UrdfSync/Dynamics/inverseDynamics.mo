within UrdfSync.Dynamics;

function inverseDynamics "Efforts that give a motion"
  extends Modelica.Icons.Function;

  input Integer jointTree[:, 2]
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  input Real frames[size(jointTree, 1), 15]
    "One row per moving joint, as jointFrames gives them";

  input Real bodies[size(jointTree, 1) + 1, 10]
    "One row per body, as bodyInertias gives them";

  input Modelica.Units.SI.AngularVelocity w_a[3]
    "Angular velocity of the base, resolved in the base frame";

  input Modelica.Units.SI.AngularAcceleration z_a[3]
    "Angular acceleration of the base, resolved in the base frame";

  input Modelica.Units.SI.Acceleration b_a[3]
    "Acceleration of the origin of the base minus gravity, resolved in the base frame";

  input Real q[size(jointTree, 1)]
    "Positions of the moving joints, in rad or m";

  input Real v[size(jointTree, 1)]
    "Speeds of the moving joints";

  input Real a[size(jointTree, 1)]
    "Accelerations of the moving joints";

  output Real tau[size(jointTree, 1) + 6]
    "Efforts of the moving joints; then torque and force on the base, resolved in the base frame";

protected
  Integer n = size(jointTree, 1);
  Integer p = 1;
  Real R[size(jointTree, 1), 3, 3];
  Real r[size(jointTree, 1), 3];
  Real w[size(jointTree, 1) + 1, 3];
  Real z[size(jointTree, 1) + 1, 3];
  Real b[size(jointTree, 1) + 1, 3];
  Real f[size(jointTree, 1) + 1, 3];
  Real t[size(jointTree, 1) + 1, 3];
  Real e[3] = zeros(3);
  Real h[3] = zeros(3);
  Real J[3, 3] = zeros(3, 3);
algorithm
  tau := zeros(n + 6);
  R := zeros(n, 3, 3);
  r := zeros(n, 3);
  w := zeros(n + 1, 3);
  z := zeros(n + 1, 3);
  b := zeros(n + 1, 3);
  f := zeros(n + 1, 3);
  t := zeros(n + 1, 3);
  w[1, :] := w_a;
  z[1, :] := z_a;
  b[1, :] := b_a;
  for i in 1:n loop
    if jointTree[i, 2] > 0 then
      p := jointTree[i, 1];
      e := frames[i, 13:15];
      R[i, :, :] := [frames[i, 1], frames[i, 2], frames[i, 3]; frames[i, 4], frames[i, 5], frames[i, 6]; frames[i, 7], frames[i, 8], frames[i, 9]];
      r[i, :] := frames[i, 10:12];
      if jointTree[i, 2] == 2 then
        r[i, :] := r[i, :] + R[i, :, :]*e*q[i];
        w[i + 1, :] := w[p, :]*R[i, :, :];
        z[i + 1, :] := z[p, :]*R[i, :, :];
        b[i + 1, :] := (b[p, :] + cross(z[p, :], r[i, :]) + cross(w[p, :], cross(w[p, :], r[i, :])))*R[i, :, :] + 2*v[i]*cross(w[i + 1, :], e) + e*a[i];
      else
        R[i, :, :] := R[i, :, :]*UrdfSync.Dynamics.turn(e, q[i]);
        w[i + 1, :] := w[p, :]*R[i, :, :] + e*v[i];
        z[i + 1, :] := z[p, :]*R[i, :, :] + v[i]*cross(w[i + 1, :], e) + e*a[i];
        b[i + 1, :] := (b[p, :] + cross(z[p, :], r[i, :]) + cross(w[p, :], cross(w[p, :], r[i, :])))*R[i, :, :];
      end if;
    end if;
  end for;
  for i in 1:n + 1 loop
    h := bodies[i, 2:4];
    J := [bodies[i, 5], bodies[i, 8], bodies[i, 9]; bodies[i, 8], bodies[i, 6], bodies[i, 10]; bodies[i, 9], bodies[i, 10], bodies[i, 7]];
    f[i, :] := bodies[i, 1]*b[i, :] + cross(z[i, :], h) + cross(w[i, :], cross(w[i, :], h));
    t[i, :] := J*z[i, :] + cross(w[i, :], J*w[i, :]) + cross(h, b[i, :]);
  end for;
  for i in n:-1:1 loop
    if jointTree[i, 2] > 0 then
      p := jointTree[i, 1];
      tau[i] := frames[i, 13:15]*(if jointTree[i, 2] == 2 then f[i + 1, :] else t[i + 1, :]);
      f[p, :] := f[p, :] + R[i, :, :]*f[i + 1, :];
      t[p, :] := t[p, :] + R[i, :, :]*t[i + 1, :] + cross(r[i, :], R[i, :, :]*f[i + 1, :]);
    end if;
  end for;
  tau[n + 1:n + 3] := t[1, :];
  tau[n + 4:n + 6] := f[1, :];

  annotation (Documentation(info="<html>
<p>
The recursive Newton-Euler algorithm in body axes (Luh, Walker, Paul: On-line computational scheme for mechanical manipulators, 1980; Featherstone: Rigid Body
Dynamics Algorithms, section 5.3). Losses and mimic joints are not part of it.
</p>
</html>"));
end inverseDynamics;
