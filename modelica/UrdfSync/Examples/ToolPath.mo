within UrdfSync.Examples;

model ToolPath "A tool that goes round in a circle, pulled by forces that the Jacobian turns into torques"
  extends Modelica.Icons.Example;

  parameter Modelica.Units.SI.Time period = 0.002
    "Sampling period of the controller";

  parameter Modelica.Units.SI.Length radius = 0.1
    "Radius of the circle";

  parameter Modelica.Units.SI.Time round = 2
    "Time of one round";

  parameter Integer tool = 7
    "Number of the link that is moved: mounting_flange";

  parameter Modelica.Units.SI.TranslationalSpringConstant c = 20000
    "Stiffness against displacement";

  parameter Modelica.Units.SI.TranslationalDampingConstant d = 800
    "Damping against displacement";

  parameter Modelica.Units.SI.RotationalSpringConstant c_r = 100
    "Stiffness against turns";

  parameter Modelica.Units.SI.RotationalDampingConstant d_r = 5
    "Damping against turns";

  parameter Modelica.Units.SI.Angle start[6] = {0, 0.4, 0.6, 0, 0.5, 0}
    "Where the axes that turn begin";

  parameter Modelica.Units.SI.Angle rpy_ref[3] = {0, 1.5, 0}
    "Roll, pitch and yaw that the tool is to keep: those at the beginning";

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

  Modelica.Units.SI.Position r_ref[3]
    "Where the tool is to be, resolved in the world frame";

  Modelica.Units.SI.Velocity v_ref[3]
    "Its velocity";

  Modelica.Units.SI.Position error[3]
    "How far the tool is from there";

  discrete Real J[6, robot.n]
    "Jacobian of the tool: upper rows in m, lower ones without unit";

  discrete UrdfSync.Types.JointEffort tau[robot.n](each start = 0, each fixed = true)
    "Efforts of the joints";

protected
  parameter UrdfSync.Types.JointPosition q_start[robot.n] = cat(1, start, zeros(robot.n - 6))
    "Positions of the joints at the beginning";

  parameter Modelica.Units.SI.Position r_start[1, 3] = UrdfSync.Dynamics.linkPoses(robot.data.tree, q_start, {tool})
    "Where the tool begins";

  parameter Real R_ref[3, 3](each unit = "1") = UrdfSync.Functions.rotation(rpy_ref)
    "Rotation that the tool is to keep";

  Modelica.Units.SI.Angle angle
    "On the circle";

  Modelica.Units.SI.AngularVelocity speed
    "Its derivative";

  discrete Real twist[6](each start = 0, each fixed = true)
    "Velocity of the tool in m/s, and its angular velocity in rad/s";

  discrete Real wrench[6](each start = 0, each fixed = true)
    "Force on the tool in N, and torque in N.m";

equation
  // The circle begins and ends at rest.
  angle = if time < round then 2*Modelica.Constants.pi*time/round - sin(2*Modelica.Constants.pi*time/round) else 2*Modelica.Constants.pi;
  speed = if time < round then 2*Modelica.Constants.pi/round*(1 - cos(2*Modelica.Constants.pi*time/round)) else 0;
  r_ref = r_start[1, :] + radius*{0, sin(angle), 1 - cos(angle)};
  v_ref = radius*speed*{0, cos(angle), sin(angle)};
  error = robot.r_0[tool, :] - r_ref;
  for i in 1:6 loop
    motor[i].tau = tau[i];
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
    J := UrdfSync.Dynamics.jacobian(robot.data.tree, robot.q, tool);
    twist := J*robot.v;
    wrench := cat(
      1,
      -c*error + d*(v_ref - twist[1:3]),
      0.5*c_r*(cross(robot.R_0[tool, :, 1], R_ref[:, 1]) + cross(robot.R_0[tool, :, 2], R_ref[:, 2]) + cross(robot.R_0[tool, :, 3], R_ref[:, 3])) - d_r*twist[4:6]);
    tau := transpose(J)*wrench + UrdfSync.Dynamics.gravityEfforts(robot.data.tree, robot.q, world.g*world.n);
  end when;

  annotation (
    experiment(StopTime=2.2, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
Impedance control (Hogan: Impedance control: an approach to manipulation, 1985; Siciliano et al.: Robotics, 2009, section 9.2): a spring and a damper pull the tool towards a point that goes round in a
circle, and keep its attitude. The transposed Jacobian gives the torques that have the effect of their force and torque at the tool,
</p>
<pre>
tau = J(q)'*{c*(r_ref - r) + d*(v_ref - v), c_r*turn - d_r*w} + tau_g(q)
</pre>
<p>
with the efforts <code>tau_g</code> that hold the robot against gravity. No inverse of the Jacobian is needed, so the arm may pass poses in which there is none. What friction and inertia take
leaves an error of their force at the tool by <code>c</code>.
</p>
<p>
The controller works at a fixed sampling rate, as one on a robot does. The fingers of the gripper are held by a spring.
</p>
</html>"));
end ToolPath;
