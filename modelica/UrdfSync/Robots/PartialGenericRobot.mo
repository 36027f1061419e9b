within UrdfSync.Robots;

partial model PartialGenericRobot "Kinematics of a robot that is read from its record"
  extends UrdfSync.Robots.PartialRecordRobot;

protected
  parameter Real e_t[n, 3](each unit = "1") = data.turnAxes
    "Turns of the bodies per motion of their joints";

  parameter Modelica.Units.SI.Position e_s[n, 3] = data.slideAxes
    "Displacements of the bodies per motion of their joints";

  parameter Modelica.Units.SI.Mass m_b[n + 1] = data.bodyMasses
    "Masses of the bodies";

  parameter Real h[n + 1, 3](each unit = "kg.m") = data.bodyMoments
    "First moments of mass of the bodies about their origins";

  parameter Modelica.Units.SI.MomentOfInertia J[n + 1, 3, 3](each min = -Modelica.Constants.inf) = data.bodyInertias
    "Inertia tensors of the bodies about their origins";

  parameter Integer toolBody = data.linkBodies[tool]
    "Number of the body with frame_b";

  parameter Real R_tool[3, 3](each unit = "1") = data.linkRotations[tool, :, :]
    "Rotation of frame_b in its body";

  parameter Modelica.Units.SI.Position r_tool[3] = data.linkPositions[tool, :]
    "Origin of frame_b in its body";

  parameter Real isTool[nLinks](each unit = "1") = {(if k == tool then 1 else 0) for k in 1:nLinks}
    "1 for the link with frame_b, 0 for the others";

  parameter Real isToolBody[n + 1](each unit = "1") = {(if i == toolBody then 1 else 0) for i in 1:n + 1}
    "1 for the body with frame_b, 0 for the others";

  Modelica.Units.SI.AngularVelocity w_tool[3]
    "Angular velocity of the body with frame_b, resolved in it";

  Modelica.Units.SI.Force f_tool[n + 1, 3]
    "Forces through frame_b on the bodies, resolved in them";

  Modelica.Units.SI.Torque t_tool[n + 1, 3]
    "Torques through frame_b about the origins of the bodies, resolved in them";

  Real cosine[n](each unit = "1")
    "Of the angle; 1 for joints that slide";

  Real sine[n](each unit = "1")
    "Of the angle; 0 for joints that slide";

  Real R[n, 3, 3](each unit = "1")
    "Rotations of the bodies in those that carry them: v_carrier = R[i, :, :]*v_body";

  Modelica.Units.SI.Position r[n, 3]
    "Origins of the bodies in those that carry them";

  Real x_b[n + 1, 3](each unit = "1")
    "x axis of the world, resolved in the bodies";

  Real y_b[n + 1, 3](each unit = "1")
    "y axis of the world, resolved in the bodies";

  Real z_b[n + 1, 3](each unit = "1")
    "z axis of the world, resolved in the bodies";

  Modelica.Units.SI.Position r_b[n + 1, 3]
    "Origins of the bodies, resolved in the world";

  Modelica.Units.SI.AngularVelocity w[n + 1, 3]
    "Angular velocities of the bodies, resolved in them";

  Modelica.Units.SI.AngularVelocity w_a[3]
    "Angular velocity of frame_a, resolved in it";

  Modelica.Units.SI.AngularAcceleration z_a[3]
    "Angular acceleration of frame_a, resolved in it";

  Modelica.Units.SI.Velocity v_0[3]
    "Velocity of frame_a, resolved in the world";

  Modelica.Units.SI.Acceleration a_0[3]
    "Acceleration of frame_a, resolved in the world";

  Modelica.Units.SI.Acceleration b_a[3]
    "Acceleration of frame_a minus gravity, resolved in frame_a";

equation
  Connections.branch(frame_a.R, frame_b.R);
  r_b[1, :] = frame_a.r_0;
  x_b[1, :] = {frame_a.R.T[1, 1], frame_a.R.T[2, 1], frame_a.R.T[3, 1]};
  y_b[1, :] = {frame_a.R.T[1, 2], frame_a.R.T[2, 2], frame_a.R.T[3, 2]};
  z_b[1, :] = {frame_a.R.T[1, 3], frame_a.R.T[2, 3], frame_a.R.T[3, 3]};
  w_a = Modelica.Mechanics.MultiBody.Frames.angularVelocity2(frame_a.R);
  z_a = der(w_a);
  v_0 = der(frame_a.r_0);
  a_0 = der(v_0);
  b_a = Modelica.Mechanics.MultiBody.Frames.resolve2(frame_a.R, a_0 - world.gravityAcceleration(frame_a.r_0));
  w[1, :] = w_a;

  for i in 1:n loop
    cosine[i] = if data.jointTree[i, 2] == 1 then cos(q[i]) else 1;
    sine[i] = if data.jointTree[i, 2] == 1 then sin(q[i]) else 0;
    // UrdfSync.Dynamics.turn would be called anew for each of the nine elements: rumoca evaluates functions in equations so.
    R[i, :, :] = data.jointRotations[i, :, :]*[
      cosine[i] + e_t[i, 1]*e_t[i, 1]*(1 - cosine[i]), e_t[i, 1]*e_t[i, 2]*(1 - cosine[i]) - e_t[i, 3]*sine[i], e_t[i, 1]*e_t[i, 3]*(1 - cosine[i]) + e_t[i, 2]*sine[i];
      e_t[i, 2]*e_t[i, 1]*(1 - cosine[i]) + e_t[i, 3]*sine[i], cosine[i] + e_t[i, 2]*e_t[i, 2]*(1 - cosine[i]), e_t[i, 2]*e_t[i, 3]*(1 - cosine[i]) - e_t[i, 1]*sine[i];
      e_t[i, 3]*e_t[i, 1]*(1 - cosine[i]) - e_t[i, 2]*sine[i], e_t[i, 3]*e_t[i, 2]*(1 - cosine[i]) + e_t[i, 1]*sine[i], cosine[i] + e_t[i, 3]*e_t[i, 3]*(1 - cosine[i])];
    r[i, :] = data.jointOrigins[i, :] + data.jointRotations[i, :, :]*e_s[i, :]*q[i];
    x_b[i + 1, :] = x_b[data.jointTree[i, 1], :]*R[i, :, :];
    y_b[i + 1, :] = y_b[data.jointTree[i, 1], :]*R[i, :, :];
    z_b[i + 1, :] = z_b[data.jointTree[i, 1], :]*R[i, :, :];
    r_b[i + 1, :] = r_b[data.jointTree[i, 1], :] + {x_b[data.jointTree[i, 1], :]*r[i, :], y_b[data.jointTree[i, 1], :]*r[i, :], z_b[data.jointTree[i, 1], :]*r[i, :]};
    w[i + 1, :] = w[data.jointTree[i, 1], :]*R[i, :, :] + e_t[i, :]*v[i];
  end for;

  for k in 1:nLinks loop
    R_0[k, 1, :] = x_b[data.linkBodies[k], :]*data.linkRotations[k, :, :];
    R_0[k, 2, :] = y_b[data.linkBodies[k], :]*data.linkRotations[k, :, :];
    R_0[k, 3, :] = z_b[data.linkBodies[k], :]*data.linkRotations[k, :, :];
    r_0[k, :] = r_b[data.linkBodies[k], :] + {x_b[data.linkBodies[k], :]*data.linkPositions[k, :], y_b[data.linkBodies[k], :]*data.linkPositions[k, :], z_b[data.linkBodies[k], :]*data.linkPositions[k, :]};
  end for;

  // rumoca does not differentiate r_0[tool, :], which what is connected to frame_b needs: hence the products.
  for i in 1:3 loop
    frame_b.r_0[i] = isTool*r_0[:, i];
    for j in 1:3 loop
      frame_b.R.T[i, j] = isTool*R_0[:, j, i];
    end for;
    w_tool[i] = isToolBody*w[:, i];
  end for;
  frame_b.R.w = w_tool*R_tool;
  for i in 1:n + 1 loop
    f_tool[i, :] = isToolBody[i]*(R_tool*frame_b.f);
    t_tool[i, :] = isToolBody[i]*(R_tool*frame_b.t + cross(r_tool, R_tool*frame_b.f));
  end for;

  annotation (Documentation(info="<html>
<p>
What the two recursions have in common. <i>Kinematics:</i> from the base outwards, body by body, in vectors of three (Featherstone: Rigid Body Dynamics
Algorithms, 2008, section 4.3). A turn about a unit vector is the formula of Rodrigues (section 2.8). The frames of all links are outputs.
</p>
<p>
The motion of the base comes through <code>frame_a</code>. Gravity is that of the <code>world</code> at the origin of <code>frame_a</code>, and the same
for the whole robot.
</p>
</html>"));
end PartialGenericRobot;
