within UrdfSync.Examples;

model ComputedTorque "An arm that follows a motion, by inverse dynamics and feedback"
  extends Modelica.Icons.Example;

  parameter Modelica.Units.SI.Time period = 0.002
    "Sampling period of the controller";

  parameter Modelica.Units.SI.AngularFrequency bandwidth = 40
    "Eigenfrequency of the error, with a damping ratio of 1";

  parameter Modelica.Units.SI.Time rise = 0.6
    "Time of the motion";

  parameter Modelica.Units.SI.Angle start[6] = {0, 0.4, 0.6, 0, 0.5, 0}
    "Where the axes that turn begin";

  parameter Modelica.Units.SI.Angle way[6] = {0.8, 0.3, -0.4, 0.5, 0.4, -0.6}
    "How far they go";

  inner Modelica.Mechanics.MultiBody.World world(n = {0, 0, -1})
    "Origin and gravity"
    annotation (Placement(transformation(extent={{-20, -50}, {0, -30}})));

  UrdfSync.Robots.GenericRobot robot(
    redeclare parameter UrdfSync.Examples.SixAxisArm.SixAxisArmParameters data,
    phi_start = start)
    "Six-axis arm"
    annotation (Placement(transformation(extent={{40, -60}, {80, -20}})));

  Modelica.Mechanics.Rotational.Sources.Torque motor[6](each useSupport = true)
    "Motors of the axes that turn"
    annotation (Placement(transformation(extent={{0, 10}, {20, 30}})));

  Modelica.Mechanics.Translational.Components.SpringDamper gripper(
    c = 1e4,
    d = 200)
    "Holds the fingers where they begin"
    annotation (Placement(transformation(extent={{50, 10}, {70, 30}})));

  UrdfSync.Types.JointPosition q_ref[robot.n]
    "Positions that the joints are to have";

  UrdfSync.Types.JointVelocity v_ref[robot.n]
    "Velocities that they are to have";

  UrdfSync.Types.JointAcceleration a_ref[robot.n]
    "Accelerations that they are to have";

  discrete UrdfSync.Types.JointEffort tau[robot.n](each start = 0, each fixed = true)
    "Efforts that give the motion";

  Modelica.Units.SI.Torque loss[6]
    "Damping and friction at the velocities that the axes are to have";

  Modelica.Units.SI.Angle error[6]
    "How far the axes that turn are from where they are to be";

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
    q_ref[i] = start[i] + way[i]*course;
    v_ref[i] = way[i]*speed;
    a_ref[i] = way[i]*acceleration;
    error[i] = robot.phi[i] - q_ref[i];
    loss[i] = robot.data.turningLosses.damping[i]*v_ref[i]
      + robot.data.turningLosses.friction[i]*tanh(0.5*robot.data.turningLosses.steepness[i]*v_ref[i]);
    motor[i].tau = tau[i] + loss[i];
  end for;
  for i in 7:robot.n loop
    q_ref[i] = robot.q[i];
    v_ref[i] = robot.v[i];
    a_ref[i] = 0;
  end for;
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{0, -40}, {40, -40}}, color={95, 95, 95}, thickness=0.5));
  connect(motor.flange, robot.rotationalAxis)
    annotation (Line(points={{20, 20}, {48, 20}, {48, -20}}, color={0, 0, 0}));
  connect(motor.support, robot.rotationalSupport)
    annotation (Line(points={{10, 10}, {10, 0}, {54, 0}, {54, -20}}, color={0, 0, 0}));
  connect(gripper.flange_b, robot.translationalAxis[1])
    annotation (Line(points={{70, 20}, {76, 20}, {76, 0}, {66, 0}, {66, -20}}, color={0, 127, 0}));
  connect(gripper.flange_a, robot.translationalSupport[1])
    annotation (Line(points={{50, 20}, {44, 20}, {44, -6}, {72, -6}, {72, -20}}, color={0, 127, 0}));

algorithm
  when sample(0, period) then
    tau := UrdfSync.Dynamics.inverseDynamics(
      robot.data.tree,
      robot.q,
      robot.v,
      a_ref + 2*bandwidth*(v_ref - robot.v) + bandwidth^2*(q_ref - robot.q));
  end when;

  annotation (
    experiment(StopTime=0.8, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
Computed-torque control, also known as inverse dynamics control (Siciliano et al.: Robotics, 2009, section 8.5.2). The inverse dynamics
</p>
<pre>
tau = M(q)*a + h(q, v),   a = a_ref + 2*w*(v_ref - v) + w^2*(q_ref - q)
</pre>
<p>
make the error of each axis a linear oscillator of second order, with the eigenfrequency <code>w</code> in rad/s and critical damping:
<code>e'' + 2*w*e' + w^2*e = 0</code>. The losses of the joints are not part of the inverse dynamics; they are added for the velocities that the axes are to have. Without them
an error of <code>loss/(w^2*inertia)</code> would stay.
</p>
<p>
The controller works at a fixed sampling rate, as one on a robot does. Joints 7 to 9 are the fingers and the pinion of the gripper, which a spring holds.
</p>
</html>"));
end ComputedTorque;
