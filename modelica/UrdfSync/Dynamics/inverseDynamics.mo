within UrdfSync.Dynamics;

function inverseDynamics "Efforts that give a motion"
  extends Modelica.Icons.Function;

  input UrdfSync.Records.RigidBodyTree tree
    "Bodies and joints: the component tree of the robot's record";

  input UrdfSync.Types.JointPosition q[:]
    "Positions of the moving joints";

  input UrdfSync.Types.JointVelocity v[:]
    "Velocities of the moving joints";

  input UrdfSync.Types.JointAcceleration a[:]
    "Accelerations of the moving joints";

  input Modelica.Units.SI.AngularVelocity w_a[3] = zeros(3)
    "Angular velocity of the base, resolved in the base frame";

  input Modelica.Units.SI.AngularAcceleration z_a[3] = zeros(3)
    "Angular acceleration of the base, resolved in the base frame";

  input Modelica.Units.SI.Acceleration b_a[3] = {0, 0, Modelica.Constants.g_n}
    "Acceleration of the origin of the base minus gravity, resolved in the base frame";

  output UrdfSync.Types.JointEffort tau[size(q, 1)]
    "Efforts of the moving joints";

  output Modelica.Units.SI.Torque t_a[3]
    "Torque on the base about its origin, resolved in the base frame";

  output Modelica.Units.SI.Force f_a[3]
    "Force on the base, resolved in the base frame";

protected
  Integer p = 1;
  Real R[size(q, 1), 3, 3](each unit = "1") = zeros(size(q, 1), 3, 3);
  Modelica.Units.SI.Position r[size(q, 1), 3] = zeros(size(q, 1), 3);
  Modelica.Units.SI.AngularVelocity w[size(q, 1) + 1, 3] = zeros(size(q, 1) + 1, 3);
  Modelica.Units.SI.AngularAcceleration z[size(q, 1) + 1, 3] = zeros(size(q, 1) + 1, 3);
  Modelica.Units.SI.Acceleration b[size(q, 1) + 1, 3] = zeros(size(q, 1) + 1, 3);
  Modelica.Units.SI.Force f[size(q, 1) + 1, 3] = zeros(size(q, 1) + 1, 3);
  Modelica.Units.SI.Torque t[size(q, 1) + 1, 3] = zeros(size(q, 1) + 1, 3);
  Real h[3](each unit = "kg.m") = zeros(3);
algorithm
  w[1, :] := w_a;
  z[1, :] := z_a;
  b[1, :] := b_a;
  for i in 1:size(q, 1) loop
    p := tree.jointTree[i, 1];
    R[i, :, :] := tree.jointRotations[i, :, :]*UrdfSync.Dynamics.turn(tree.turnAxes[i, :], if tree.jointTree[i, 2] == 1 then q[i] else 0);
    r[i, :] := tree.jointOrigins[i, :] + tree.jointRotations[i, :, :]*tree.slideAxes[i, :]*q[i];
    w[i + 1, :] := w[p, :]*R[i, :, :] + tree.turnAxes[i, :]*v[i];
    z[i + 1, :] := z[p, :]*R[i, :, :] + cross(w[i + 1, :], tree.turnAxes[i, :])*v[i] + tree.turnAxes[i, :]*a[i];
    b[i + 1, :] := (b[p, :] + cross(z[p, :], r[i, :]) + cross(w[p, :], cross(w[p, :], r[i, :])))*R[i, :, :]
      + 2*cross(w[i + 1, :], tree.slideAxes[i, :])*v[i] + tree.slideAxes[i, :]*a[i];
  end for;
  for i in 1:size(q, 1) + 1 loop
    h := tree.bodyMoments[i, :];
    f[i, :] := tree.bodyMasses[i]*b[i, :] + cross(z[i, :], h) + cross(w[i, :], cross(w[i, :], h));
    t[i, :] := tree.bodyInertias[i, :, :]*z[i, :] + cross(w[i, :], tree.bodyInertias[i, :, :]*w[i, :]) + cross(h, b[i, :]);
  end for;
  tau := zeros(size(q, 1));
  for i in size(q, 1):-1:1 loop
    p := tree.jointTree[i, 1];
    tau[i] := tree.turnAxes[i, :]*t[i + 1, :] + tree.slideAxes[i, :]*f[i + 1, :] + tree.driveInertias[i]*a[i];
    f[p, :] := f[p, :] + R[i, :, :]*f[i + 1, :];
    t[p, :] := t[p, :] + R[i, :, :]*t[i + 1, :] + cross(r[i, :], R[i, :, :]*f[i + 1, :]);
  end for;
  t_a := t[1, :];
  f_a := f[1, :];

  annotation (Documentation(info="<html>
<p>
The recursive Newton-Euler algorithm in body axes (Luh, Walker, Paul: On-line computational scheme for mechanical manipulators, 1980; Featherstone: Rigid Body
Dynamics Algorithms, 2008, section 5.3). It solves
</p>
<pre>M(q)*a + h(q, v) = tau</pre>
<p>
for <code>tau</code>, without setting up <code>M</code>. Outwards, from the body <code>p</code> that carries joint <code>i</code> to body <code>i + 1</code>, all vectors resolved in their
bodies, <code>R</code> and <code>r</code> as in <a href=\"modelica://UrdfSync.Dynamics.linkPoses\">linkPoses</a>:
</p>
<pre>
w[i + 1] = R'*w[p] + e_t*v                                                            angular velocity, rad/s
z[i + 1] = R'*z[p] + w[i + 1] x e_t*v + e_t*a                                         angular acceleration, rad/s2
b[i + 1] = R'*(b[p] + z[p] x r + w[p] x (w[p] x r)) + 2*w[i + 1] x e_s*v + e_s*a      acceleration minus gravity, m/s2
</pre>
<p>
Each body with mass <code>m</code>, first moment <code>h</code> and inertia <code>J</code> about its origin needs the force and the torque
</p>
<pre>
f = m*b + z x h + w x (w x h)           N
t = J*z + w x J*w + h x b               N.m
</pre>
<p>
and inwards they add up to what its joint hands on: <code>f[p] += R*f</code>, <code>t[p] += R*t + r x R*f</code>, of which
<code>tau = e_t*t + e_s*f</code> is along the axis. What its drive adds to the inertia adds <code>driveInertias*a</code>. Losses and mimic joints are not part of it: see
<a href=\"modelica://UrdfSync.Robots.PartialRecordRobot\">PartialRecordRobot</a>.
</p>
</html>"));
end inverseDynamics;
