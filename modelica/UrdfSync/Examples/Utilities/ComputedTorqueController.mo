within UrdfSync.Examples.Utilities;

block ComputedTorqueController "Follows a motion, by inverse dynamics and feedback"
  extends UrdfSync.Examples.Utilities.PartialController;

  parameter Modelica.Units.SI.AngularFrequency bandwidth = 40
    "Eigenfrequency of the error, with a damping ratio of 1";

  parameter Modelica.Units.SI.Time rise = 0.6
    "Time of the motion";

  parameter Modelica.Units.SI.Angle way[6] = {0.8, 0.3, -0.4, 0.5, 0.4, -0.6}
    "How far the axes go";

  Modelica.Units.SI.Angle phi_ref[6]
    "Positions that the axes are to have";

  Modelica.Units.SI.AngularVelocity w_ref[6]
    "Speeds that they are to have";

  Modelica.Units.SI.AngularAcceleration a_ref[6]
    "Accelerations that they are to have";

  Modelica.Units.SI.Angle error[6]
    "How far the axes are from where they are to be";

  discrete UrdfSync.Types.JointEffort effort[9](each start = 0, each fixed = true)
    "Efforts of the moving joints that give the motion";

  Modelica.Units.SI.Torque loss[6]
    "Damping and friction at the speeds that the axes are to have";

protected
  Real course
    "Part of the way";

  Real speed(unit = "1/s")
    "Its derivative";

  Real acceleration(unit = "1/s2")
    "Its second derivative";

equation
  course = if time < rise then time/rise - sin(2*Modelica.Constants.pi*time/rise)/(2*Modelica.Constants.pi) else 1;
  speed = if time < rise then (1 - cos(2*Modelica.Constants.pi*time/rise))/rise else 0;
  acceleration = if time < rise then 2*Modelica.Constants.pi*sin(2*Modelica.Constants.pi*time/rise)/rise^2 else 0;
  for i in 1:6 loop
    phi_ref[i] = start[i] + way[i]*course;
    w_ref[i] = way[i]*speed;
    a_ref[i] = way[i]*acceleration;
    error[i] = phi[i] - phi_ref[i];
    loss[i] = data.turningLosses.damping[i]*w_ref[i]
      + data.turningLosses.friction[i]*tanh(0.5*data.turningLosses.steepness[i]*w_ref[i]);
    tau[i] = effort[i] + loss[i];
  end for;

algorithm
  when sample(0, period) then
    effort := UrdfSync.Dynamics.inverseDynamics(
      data.tree,
      q,
      v,
      cat(1, a_ref + 2*bandwidth*(w_ref - w) + bandwidth^2*(phi_ref - phi), zeros(3)));
  end when;

  annotation (Documentation(info="<html>
<p>
Computed-torque control, also known as inverse dynamics control (Siciliano et al.: Robotics, 2009, section 8.5.2). The inverse dynamics
</p>
<pre>
tau = M(q)*a + h(q, v),   a = a_ref + 2*w*(v_ref - v) + w^2*(q_ref - q)
</pre>
<p>
make the error of each axis a linear oscillator of second order, with the eigenfrequency <code>w</code> in rad/s and critical damping:
<code>e'' + 2*w*e' + w^2*e = 0</code>. The losses of the joints are not part of the inverse dynamics; they are added for the velocities that the axes are to have. Without them
an error of <code>loss/(w^2*inertia)</code> would stay. The controller works at a fixed sampling rate, as one on a robot does.
</p>
</html>"));
end ComputedTorqueController;
