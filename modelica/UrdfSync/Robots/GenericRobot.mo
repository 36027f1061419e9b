within UrdfSync.Robots;

model GenericRobot "Any robot, read from its record: Newton-Euler equations"
  extends UrdfSync.Robots.PartialGenericRobot;

protected
  Modelica.Units.SI.AngularAcceleration z[n + 1, 3]
    "Angular accelerations of the bodies, resolved in them";

  Modelica.Units.SI.Acceleration b[n + 1, 3]
    "Accelerations of their origins minus gravity, resolved in them";

  Modelica.Units.SI.Force f[n + 1, 3]
    "Forces that move each body and what it carries, resolved in the body";

  Modelica.Units.SI.Torque t[n + 1, 3]
    "Torques about the origin of the body, resolved in it";

  Modelica.Units.SI.Force f_c[n + 1, 3]
    "Forces of a joint's body and of those behind the next joints on the same carrier, resolved in that";

  Modelica.Units.SI.Torque t_c[n + 1, 3]
    "Torques about the origin of the carrier, added up likewise";

equation
  z[1, :] = z_a;
  b[1, :] = b_a;
  f_c[n + 1, :] = {0, 0, 0};
  t_c[n + 1, :] = {0, 0, 0};

  for i in 1:n loop
    z[i + 1, :] = z[data.jointTree[i, 1], :]*R[i, :, :] + e_t[i, :]*a[i] + cross(w[i + 1, :], e_t[i, :])*v[i];
    b[i + 1, :] = (b[data.jointTree[i, 1], :] + cross(z[data.jointTree[i, 1], :], r[i, :]) + cross(w[data.jointTree[i, 1], :], cross(w[data.jointTree[i, 1], :], r[i, :])))*R[i, :, :]
      + 2*v[i]*cross(w[i + 1, :], e_s[i, :]) + e_s[i, :]*a[i];
    f_c[i, :] = R[i, :, :]*f[i + 1, :] + f_c[data.nextJoints[i], :];
    t_c[i, :] = R[i, :, :]*t[i + 1, :] + cross(r[i, :], R[i, :, :]*f[i + 1, :]) + t_c[data.nextJoints[i], :];
    effort[i] = e_t[i, :]*t[i + 1, :] + e_s[i, :]*f[i + 1, :] + data.driveInertias[i]*a[i];
  end for;

  for i in 1:n + 1 loop
    f[i, :] = m_b[i]*b[i, :] + cross(z[i, :], h[i, :]) + cross(w[i, :], cross(w[i, :], h[i, :])) - f_tool[i, :] + f_c[data.firstJoints[i], :];
    t[i, :] = J[i, :, :]*z[i, :] + cross(w[i, :], J[i, :, :]*w[i, :]) + cross(h[i, :], b[i, :]) - t_tool[i, :] + t_c[data.firstJoints[i], :];
  end for;

  frame_a.f = f[1, :];
  frame_a.t = t[1, :];

  annotation (Documentation(info="<html>
<p>
The recursive Newton-Euler algorithm (Luh, Walker, Paul: On-line computational scheme for mechanical manipulators, 1980; Featherstone: Rigid Body
Dynamics Algorithms, 2008, section 5.3), written as equations in the axes of the bodies: velocities and accelerations from the base outwards, forces and
torques from the leaves inwards. Gravity enters as an acceleration of the base. For joint <code>i</code>, which moves body <code>k = i + 1</code> and is carried by body <code>p</code>:
</p>
<pre>
w_k = R'*w_p + e_t*v                                                      rad/s
z_k = R'*z_p + w_k x e_t*v + e_t*a                                        rad/s2
b_k = R'*(b_p + z_p x r + w_p x (w_p x r)) + 2*w_k x e_s*v + e_s*a        m/s2
f_k = m*b_k + z_k x h + w_k x (w_k x h) - f_tool + sum(R*f)               N
t_k = J*z_k + w_k x J*w_k + h x b_k - t_tool + sum(R*t + r x R*f)         N.m
effort = e_t*t_k + e_s*f_k                                                N.m
</pre>
<p>
with mass <code>m</code>, first moment <code>h</code> and inertia <code>J</code> of the body, the axes <code>e_t</code> and <code>e_s</code> of turning and sliding joints, one of which is zero, and
what acts at <code>frame_b</code>. The sums are over the joints that the body carries.
</p>
<p>
The equations hold for prescribed and for free motion. Where axes move freely a tool has to solve them for the accelerations: a system of linear
equations whose matrix is the mass matrix. A tool that does not reduce this system to the number of axes is better served by
<a href=\"modelica://UrdfSync.Robots.ArticulatedRobot\">ArticulatedRobot</a>.
</p>
</html>"));
end GenericRobot;
