within UrdfSync.Examples;

model ToolPath "A tool that goes round in a circle, pulled by forces that the Jacobian turns into torques"
  extends Modelica.Icons.Example;

  parameter Modelica.Units.SI.Time period = 0.001
    "Sampling period of the controller";

  parameter Modelica.Units.SI.Length radius = 0.1
    "Radius of the circle";

  parameter Modelica.Units.SI.Time round = 2
    "Time of one round";

  parameter Integer tool = 8
    "Number of the link that is moved: tool0";

  parameter Modelica.Units.SI.TranslationalSpringConstant c = 5000
    "Stiffness against displacement";

  parameter Modelica.Units.SI.TranslationalDampingConstant d = 300
    "Damping against displacement";

  parameter Modelica.Units.SI.RotationalSpringConstant c_r = 100
    "Stiffness against turns";

  parameter Modelica.Units.SI.RotationalDampingConstant d_r = 5
    "Damping against turns";

  parameter Modelica.Units.SI.Angle start[6] = {0, 0.4, 0.6, 0, 0.5, 0}
    "Where the axes that turn begin";

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
  discrete Modelica.Units.SI.Position r_start[3]
    "Where the tool begins";

  discrete Real R_start[3, 3](each unit = "1")
    "Its rotation there, which it is to keep";

  Real angle
    "On the circle; it begins and ends at rest";

  Real speed
    "Its derivative";

equation
