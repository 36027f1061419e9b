within UrdfSync.Robots;

model ArticulatedRobot "Any robot, read from its record: articulated-body equations"
  extends UrdfSync.Robots.PartialGenericRobot;

protected
  Modelica.Units.SI.AngularAcceleration z[n + 1, 3]
    "Angular accelerations of the bodies, resolved in them";

  Modelica.Units.SI.Acceleration b[n + 1, 3]
    "Accelerations of their origins minus gravity, resolved in them";

  Real J_A[n + 1, 3, 3](each unit = "kg.m2")
    "Articulated inertias: torque per angular acceleration";

  Real H_A[n + 1, 3, 3](each unit = "kg.m")
    "Articulated inertias: torque per acceleration";

  Real M_A[n + 1, 3, 3](each unit = "kg")
    "Articulated inertias: force per acceleration";

  Modelica.Units.SI.Torque t_A[n + 1, 3]
    "Torques of the articulated bodies at acceleration zero";

  Modelica.Units.SI.Force f_A[n + 1, 3]
    "Forces of the articulated bodies at acceleration zero";

  Real U_t[n, 3](each unit = "kg.m2")
    "Torque per acceleration of the joint";

  Real U_f[n, 3](each unit = "kg.m")
    "Force per acceleration of the joint";

  Real D[n](each unit = "kg.m2")
    "Effort per acceleration of the joint, all behind it free to move";

  Real u[n](each unit = "N.m")
    "Effort that is left to accelerate the joint";

  Modelica.Units.SI.AngularAcceleration z_v[n, 3]
    "Angular accelerations that speeds cause";

  Modelica.Units.SI.Acceleration b_v[n, 3]
    "Accelerations that speeds cause";

  Real J_r[n, 3, 3](each unit = "kg.m2")
    "Of J_A, what the joint hands on";

  Real H_r[n, 3, 3](each unit = "kg.m")
    "Of H_A, what the joint hands on";

  Real M_r[n, 3, 3](each unit = "kg")
    "Of M_A, what the joint hands on";

  Modelica.Units.SI.Torque t_r[n, 3]
    "Torques that the joint hands on, about its origin, resolved in the carrier";

  Modelica.Units.SI.Force f_r[n, 3]
    "Forces that the joint hands on, resolved in the carrier";

  Modelica.Units.SI.AngularAcceleration z_c[n, 3]
    "Angular accelerations without that of the joint";

  Modelica.Units.SI.Acceleration b_c[n, 3]
    "Accelerations without that of the joint";

  Real J_c[n, 3, 3](each unit = "kg.m2")
    "J_r, resolved in the carrier";

  Real H_c[n, 3, 3](each unit = "kg.m")
    "H_r, resolved in the carrier";

  Real M_c[n, 3, 3](each unit = "kg")
    "M_r, resolved in the carrier";

  Real H_o[n, 3, 3](each unit = "kg.m")
    "The same about the origin of the carrier: torque per acceleration";

  Real J_o[n, 3, 3](each unit = "kg.m2")
    "Likewise: torque per angular acceleration";

  Real S[n, 3, 3](each unit = "m")
    "Cross product with the origin of the body";

  Modelica.Units.SI.Torque t_s[n + 1, 3]
    "Sums over a joint and the next ones on the same carrier: torque";

  Modelica.Units.SI.Force f_s[n + 1, 3]
    "Sums likewise: force";

  Real J_s[n + 1, 3, 3](each unit = "kg.m2")
    "Sums likewise: torque per angular acceleration";

  Real H_s[n + 1, 3, 3](each unit = "kg.m")
    "Sums likewise: torque per acceleration";

  Real M_s[n + 1, 3, 3](each unit = "kg")
    "Sums likewise: force per acceleration";

equation
  z[1, :] = z_a;
  b[1, :] = b_a;
  J_s[n + 1, :, :] = zeros(3, 3);
  H_s[n + 1, :, :] = zeros(3, 3);
  M_s[n + 1, :, :] = zeros(3, 3);
  t_s[n + 1, :] = {0, 0, 0};
  f_s[n + 1, :] = {0, 0, 0};

  for i in 1:n + 1 loop
    J_A[i, :, :] = J[i, :, :] + J_s[data.firstJoints[i], :, :];
    H_A[i, :, :] = skew(h[i, :]) + H_s[data.firstJoints[i], :, :];
    M_A[i, :, :] = m_b[i]*identity(3) + M_s[data.firstJoints[i], :, :];
    t_A[i, :] = cross(w[i, :], J[i, :, :]*w[i, :]) - t_tool[i, :] + t_s[data.firstJoints[i], :];
    f_A[i, :] = cross(w[i, :], cross(w[i, :], h[i, :])) - f_tool[i, :] + f_s[data.firstJoints[i], :];
  end for;

  for i in 1:n loop
    assert(jointInertias[i] > 0,
      getInstanceName() + " (joint " + data.jointNames[i].name + ") of robot " + data.name + " has no inertia about or along its own axis, by which these "
      + "equations divide: use GenericRobot");
    assert(noEvent(D[i] > 1e-12*jointInertias[i]),
      getInstanceName() + " (joint " + data.jointNames[i].name + ") of robot " + data.name + " has no inertia about or along its own axis if the joints behind it "
      + "undo its motion, and these equations divide by that: use GenericRobot, and drive the joint by position");
    z_v[i, :] = cross(w[i + 1, :], e_t[i, :])*v[i];
    b_v[i, :] = cross(w[data.jointTree[i, 1], :], cross(w[data.jointTree[i, 1], :], r[i, :]))*R[i, :, :] + 2*v[i]*cross(w[i + 1, :], e_s[i, :]);
    U_t[i, :] = J_A[i + 1, :, :]*e_t[i, :] + H_A[i + 1, :, :]*e_s[i, :];
    U_f[i, :] = e_t[i, :]*H_A[i + 1, :, :] + M_A[i + 1, :, :]*e_s[i, :];
    D[i] = if jointInertias[i] > 0 then e_t[i, :]*U_t[i, :] + e_s[i, :]*U_f[i, :] + data.driveInertias[i] else 1;
    u[i] = effort[i] - e_t[i, :]*t_A[i + 1, :] - e_s[i, :]*f_A[i + 1, :];
    for j in 1:3 loop
      for k in 1:3 loop
        J_r[i, j, k] = J_A[i + 1, j, k] - U_t[i, j]*U_t[i, k]/D[i];
        H_r[i, j, k] = H_A[i + 1, j, k] - U_t[i, j]*U_f[i, k]/D[i];
        M_r[i, j, k] = M_A[i + 1, j, k] - U_f[i, j]*U_f[i, k]/D[i];
      end for;
    end for;
    t_r[i, :] = R[i, :, :]*(t_A[i + 1, :] + J_r[i, :, :]*z_v[i, :] + H_r[i, :, :]*b_v[i, :] + U_t[i, :]*(u[i]/D[i]));
    f_r[i, :] = R[i, :, :]*(f_A[i + 1, :] + z_v[i, :]*H_r[i, :, :] + M_r[i, :, :]*b_v[i, :] + U_f[i, :]*(u[i]/D[i]));
    t_s[i, :] = t_r[i, :] + cross(r[i, :], f_r[i, :]) + t_s[data.nextJoints[i], :];
    f_s[i, :] = f_r[i, :] + f_s[data.nextJoints[i], :];
    J_c[i, :, :] = R[i, :, :]*J_r[i, :, :]*transpose(R[i, :, :]);
    H_c[i, :, :] = R[i, :, :]*H_r[i, :, :]*transpose(R[i, :, :]);
    M_c[i, :, :] = R[i, :, :]*M_r[i, :, :]*transpose(R[i, :, :]);
    S[i, :, :] = skew(r[i, :]);
    H_o[i, :, :] = H_c[i, :, :] + S[i, :, :]*M_c[i, :, :];
    M_s[i, :, :] = M_c[i, :, :] + M_s[data.nextJoints[i], :, :];
    H_s[i, :, :] = H_o[i, :, :] + H_s[data.nextJoints[i], :, :];
    J_o[i, :, :] = J_c[i, :, :] - H_o[i, :, :]*S[i, :, :] + S[i, :, :]*transpose(H_c[i, :, :]);
    J_s[i, :, :] = J_o[i, :, :] + J_s[data.nextJoints[i], :, :];
    z_c[i, :] = z[data.jointTree[i, 1], :]*R[i, :, :] + z_v[i, :];
    b_c[i, :] = (b[data.jointTree[i, 1], :] + cross(z[data.jointTree[i, 1], :], r[i, :]))*R[i, :, :] + b_v[i, :];
    a[i] = (u[i] - U_t[i, :]*z_c[i, :] - U_f[i, :]*b_c[i, :])/D[i];
    z[i + 1, :] = z_c[i, :] + e_t[i, :]*a[i];
    b[i + 1, :] = b_c[i, :] + e_s[i, :]*a[i];
  end for;

  frame_a.t = t_A[1, :] + J_A[1, :, :]*z[1, :] + H_A[1, :, :]*b[1, :];
  frame_a.f = f_A[1, :] + z[1, :]*H_A[1, :, :] + M_A[1, :, :]*b[1, :];

  annotation (Documentation(info="<html>
<p>
The articulated-body algorithm (Featherstone: The calculation of robot dynamics using articulated-body inertias, 1983; Rigid Body Dynamics Algorithms,
2008, section 7.3), written as equations in the axes of the bodies: one joint after the other is solved for its acceleration, so that no tool has to
solve a system of equations where all axes move freely. Mimic joints join axes, and are solved as a small system. It takes about three times as many
equations as <a href=\"modelica://UrdfSync.Robots.GenericRobot\">GenericRobot</a>, and gives the same motion.
</p>
<pre>
U = I_A*e,   D = e'*U + J_d,   u = effort - e'*p_A
a = (u - U'*a_p)/D
I_A of the carrier += X*(I_A - U*U'/D)*X'
</pre>
<p>
for each joint, with its axis <code>e = {e_t, e_s}</code>, the articulated inertia <code>I_A</code> and the bias force <code>p_A</code> of its body, and the spatial acceleration <code>a_p</code> that comes
from its carrier; <code>J_d</code> is what the drive adds to the inertia. <code>D</code> is in kg.m2, <code>u</code> in N.m, <code>a</code> in 1/s2: see <a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a>.
</p>
<p>
Symmetric 6 x 6 inertias are kept as three matrices: torque per angular acceleration <code>J</code>, torque per acceleration <code>H</code> (force per angular
acceleration is its transpose) and force per acceleration <code>M</code>. The equations divide by
<code>D</code>, the inertia of each joint by itself. So a joint with none is refused by name, also where its motion is prescribed, where it follows another one, and
where only joints that follow it have mass: <a href=\"modelica://UrdfSync.Robots.GenericRobot\">GenericRobot</a> takes the latter two. Of two joints on the same axis with
nothing between them the first is refused as well: its free motion has no solution, and it can be driven by position in GenericRobot only.
</p>
</html>"));
end ArticulatedRobot;
