within UrdfSync.Examples.Utilities;

partial model NamedMotorArm "The six-axis arm of the package approach, with a motor at each axis by name"
  extends UrdfSync.Examples.Utilities.PartialMotorArm;

  UrdfSync.Examples.SixAxisArm.SixAxisArm robot(
    turret(phi_start = start[1]),
    shoulder(phi_start = start[2]),
    elbow(phi_start = start[3]),
    forearm_roll(phi_start = start[4]),
    wrist_pitch(phi_start = start[5]),
    flange_roll(phi_start = start[6]))
    "Six-axis arm"
    annotation (Placement(transformation(extent={{40, -190}, {340, 335}})));

  Modelica.Mechanics.Rotational.Sources.Torque turretMotor(useSupport = true)
    "Motor of joint \"turret\""
    annotation (Placement(transformation(extent={{-40, 310}, {-20, 330}})));

  Modelica.Mechanics.Rotational.Sources.Torque shoulderMotor(useSupport = true)
    "Motor of joint \"shoulder\""
    annotation (Placement(transformation(extent={{-40, 280}, {-20, 300}})));

  Modelica.Mechanics.Rotational.Sources.Torque elbowMotor(useSupport = true)
    "Motor of joint \"elbow\""
    annotation (Placement(transformation(extent={{-40, 250}, {-20, 270}})));

  Modelica.Mechanics.Rotational.Sources.Torque forearm_rollMotor(useSupport = true)
    "Motor of joint \"forearm_roll\""
    annotation (Placement(transformation(extent={{-40, 220}, {-20, 240}})));

  Modelica.Mechanics.Rotational.Sources.Torque wrist_pitchMotor(useSupport = true)
    "Motor of joint \"wrist_pitch\""
    annotation (Placement(transformation(extent={{-40, 190}, {-20, 210}})));

  Modelica.Mechanics.Rotational.Sources.Torque flange_rollMotor(useSupport = true)
    "Motor of joint \"flange_roll\""
    annotation (Placement(transformation(extent={{-40, 160}, {-20, 180}})));

  Modelica.Mechanics.Translational.Components.SpringDamper gripper(
    c = 1e4,
    d = 200)
    "Holds the fingers where they begin"
    annotation (Placement(transformation(extent={{-40, 130}, {-20, 150}})));

equation
  phi[1] = robot.turretAxis.phi - robot.turretSupport.phi;
  phi[2] = robot.shoulderAxis.phi - robot.shoulderSupport.phi;
  phi[3] = robot.elbowAxis.phi - robot.elbowSupport.phi;
  phi[4] = robot.forearm_rollAxis.phi - robot.forearm_rollSupport.phi;
  phi[5] = robot.wrist_pitchAxis.phi - robot.wrist_pitchSupport.phi;
  phi[6] = robot.flange_rollAxis.phi - robot.flange_rollSupport.phi;
  w = der(phi);
  r_tool = robot.tool0Frame.r_0;
  R_tool = transpose(robot.tool0Frame.R.T);
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{0, -40}, {40, -40}}, color={95, 95, 95}, thickness=0.5));
  connect(turretMotor.flange, robot.turretAxis)
    annotation (Line(points={{-20, 320}, {40, 320}}, color={0, 0, 0}));
  connect(turretMotor.support, robot.turretSupport)
    annotation (Line(points={{-30, 310}, {-30, 305}, {40, 305}}, color={0, 0, 0}));
  connect(shoulderMotor.flange, robot.shoulderAxis)
    annotation (Line(points={{-20, 290}, {40, 290}}, color={0, 0, 0}));
  connect(shoulderMotor.support, robot.shoulderSupport)
    annotation (Line(points={{-30, 280}, {-30, 275}, {40, 275}}, color={0, 0, 0}));
  connect(elbowMotor.flange, robot.elbowAxis)
    annotation (Line(points={{-20, 260}, {40, 260}}, color={0, 0, 0}));
  connect(elbowMotor.support, robot.elbowSupport)
    annotation (Line(points={{-30, 250}, {-30, 245}, {40, 245}}, color={0, 0, 0}));
  connect(forearm_rollMotor.flange, robot.forearm_rollAxis)
    annotation (Line(points={{-20, 230}, {40, 230}}, color={0, 0, 0}));
  connect(forearm_rollMotor.support, robot.forearm_rollSupport)
    annotation (Line(points={{-30, 220}, {-30, 215}, {40, 215}}, color={0, 0, 0}));
  connect(wrist_pitchMotor.flange, robot.wrist_pitchAxis)
    annotation (Line(points={{-20, 200}, {40, 200}}, color={0, 0, 0}));
  connect(wrist_pitchMotor.support, robot.wrist_pitchSupport)
    annotation (Line(points={{-30, 190}, {-30, 185}, {40, 185}}, color={0, 0, 0}));
  connect(flange_rollMotor.flange, robot.flange_rollAxis)
    annotation (Line(points={{-20, 170}, {40, 170}}, color={0, 0, 0}));
  connect(flange_rollMotor.support, robot.flange_rollSupport)
    annotation (Line(points={{-30, 160}, {-30, 155}, {40, 155}}, color={0, 0, 0}));
  connect(gripper.flange_b, robot.gripper_strokeAxis)
    annotation (Line(points={{-20, 140}, {40, 140}}, color={0, 127, 0}));
  connect(gripper.flange_a, robot.gripper_strokeSupport)
    annotation (Line(points={{-40, 140}, {-46, 140}, {-46, 125}, {40, 125}}, color={0, 127, 0}));

  annotation (
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 345}})),
    Documentation(info="<html>
<p>
Each motor is connected to the axis and the housing of its joint, <code>turretAxis</code> and <code>turretSupport</code>, say, and the sensors read these connectors and
<code>tool0Frame</code>. A robot with more joints leaves all that as it is. A spring holds the fingers of the gripper.
</p>
</html>"));
end NamedMotorArm;
