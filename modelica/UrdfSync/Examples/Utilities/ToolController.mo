within UrdfSync.Examples.Utilities;

block ToolController "Pulls a tool round in a circle, by forces that the Jacobian turns into torques"
  extends UrdfSync.Examples.Utilities.PartialController;

  parameter Modelica.Units.SI.Length radius = 0.1
    "Radius of the circle";

  parameter Modelica.Units.SI.Time round = 2
    "Time of one round";

  parameter Integer tool = 8
    "Number of the link that is moved: tool0";

  parameter Modelica.Units.SI.TranslationalSpringConstant c = 20000
    "Stiffness against displacement";

  parameter Modelica.Units.SI.TranslationalDampingConstant d = 800
    "Damping against displacement";

  parameter Modelica.Units.SI.RotationalSpringConstant c_r = 100
    "Stiffness against turns";

  parameter Modelica.Units.SI.RotationalDampingConstant d_r = 0.8
    "Damping against turns";

  parameter Modelica.Units.SI.Angle rpy_ref[3] = {0, 1.5 + Modelica.Constants.pi/2, 0}
    "Roll, pitch and yaw that the tool is to keep: those of the default of start";

  parameter Modelica.Units.SI.Acceleration g[3] = {0, 0, -Modelica.Constants.g_n}
    "Gravity, resolved in the base frame";

  Modelica.Blocks.Interfaces.RealInput r[3](each unit = "m")
    "Where the tool is, resolved in the world frame"
    annotation (Placement(transformation(extent={{-140, -60}, {-100, -20}})));

  Modelica.Blocks.Interfaces.RealInput R[3, 3](each unit = "1")
    "Its rotation, v_world = R*v_tool"
    annotation (Placement(transformation(extent={{-140, -100}, {-100, -60}})));

  Modelica.Units.SI.Position r_ref[3]
    "Where the tool is to be, resolved in the world frame";

  Modelica.Units.SI.Velocity v_ref[3]
    "Its velocity";

  Modelica.Units.SI.Position error[3]
    "How far the tool is from there";

  Modelica.Units.SI.Angle angle
    "On the circle";

  discrete Real J[6, 9](each start = 0, each fixed = true)
    "Jacobian of the tool: upper rows in m, lower ones without unit";

  discrete UrdfSync.Types.JointEffort effort[9](each start = 0, each fixed = true)
    "Efforts of the moving joints";

protected
  parameter Modelica.Units.SI.Position r_start[1, 3] = UrdfSync.Dynamics.linkPoses(data.tree, cat(1, start, zeros(3)), {tool})
    "Where the tool begins";

  parameter Real R_ref[3, 3](each unit = "1") = UrdfSync.Functions.rotation(rpy_ref)
    "Rotation that the tool is to keep";

  Modelica.Units.SI.AngularVelocity speed
    "Derivative of angle";

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
  error = r - r_ref;
  for i in 1:6 loop
    tau[i] = effort[i];
  end for;

algorithm
  when sample(0, period) then
    J := UrdfSync.Dynamics.jacobian(data.tree, q, tool);
    twist := J*v;
    wrench := cat(
      1,
      -c*error + d*(v_ref - twist[1:3]),
      0.5*c_r*(cross(R[:, 1], R_ref[:, 1]) + cross(R[:, 2], R_ref[:, 2]) + cross(R[:, 3], R_ref[:, 3])) - d_r*twist[4:6]);
    effort := transpose(J)*wrench + UrdfSync.Dynamics.gravityEfforts(data.tree, q, g);
  end when;

  annotation (Documentation(info="<html>
<p>
Impedance control (Hogan: Impedance control: an approach to manipulation, 1985; Siciliano et al.: Robotics, 2009, section 9.2): a spring and a damper pull the tool towards a point that goes round in a
circle, and keep its attitude. The transposed Jacobian gives the torques that have the effect of their force and torque at the tool,
</p>
<pre>
tau = J(q)'*{c*(r_ref - r) + d*(v_ref - v), c_r*turn - d_r*w} + tau_g(q)
</pre>
<p>
with the efforts <code>tau_g</code> that hold the robot against gravity. No inverse of the Jacobian is needed, so the arm may pass poses in which there is none. What friction and inertia take
leaves an error of their force at the tool by <code>c</code>. The controller works at a fixed sampling rate, as one on a robot does.
So there is a bound to its dampers: one that takes away more than twice the speed of a part within a period lets it swing ever more. The flange with
the gripper has 0.0014 kg.m2 about its axis, and <code>d_r</code> has to stay below 1.4 N.m.s/rad there.
</p>
</html>"));
end ToolController;
