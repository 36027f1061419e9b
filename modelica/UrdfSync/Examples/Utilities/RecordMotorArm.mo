within UrdfSync.Examples.Utilities;

partial model RecordMotorArm "The six-axis arm of the record approach, with motors"
  extends UrdfSync.Examples.Utilities.PartialMotorArm;

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
    annotation (Placement(transformation(extent={{72, 10}, {92, 30}})));

protected
  constant Integer tool = 8
    "Number of link tool0";

equation
  phi = robot.phi;
  w = robot.w_phi;
  r_tool = robot.r_0[tool, :];
  R_tool = robot.R_0[tool, :, :];
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{0, -40}, {40, -40}}, color={95, 95, 95}, thickness=0.5));
  connect(motor.flange, robot.rotationalAxis)
    annotation (Line(points={{20, 20}, {48, 20}, {48, -20}}, color={0, 0, 0}));
  connect(motor.support, robot.rotationalSupport)
    annotation (Line(points={{10, 10}, {10, 0}, {54, 0}, {54, -20}}, color={0, 0, 0}));
  connect(gripper.flange_a, robot.translationalAxis[1])
    annotation (Line(points={{72, 20}, {66, 20}, {66, -20}}, color={0, 127, 0}));
  connect(gripper.flange_b, robot.translationalSupport[1])
    annotation (Line(points={{92, 20}, {96, 20}, {96, 0}, {72, 0}, {72, -20}}, color={0, 127, 0}));

  annotation (Documentation(info="<html>
<p>
<a href=\"modelica://UrdfSync.Robots.GenericRobot\">GenericRobot</a> has one vector of flanges for the axes that turn, in the order of the record. A spring holds
the fingers of the gripper.
</p>
</html>"));
end RecordMotorArm;
