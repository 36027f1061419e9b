within UrdfSync.Examples.WheeledRobot;

model WheeledRobotRun "Run robot WheeledRobot with commands from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialMobileBench(
    redeclare WheeledRobotStance stance,
    load = robot.m*world.g);

  replaceable WheeledRobot robot(
    fixedStart = false,
    caster_swivel(fixedStart = true),
    caster_roll(fixedStart = true))
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 355}})));

  Modelica.Blocks.Interfaces.RealInput drive_left_w(unit = "rad/s")
    "How fast joint \"drive_left\" is to go"
    annotation (Placement(transformation(extent={{-140, 180}, {-120, 200}}), iconTransformation(extent={{-116, 147}, {-100, 163}})));

  Modelica.Blocks.Interfaces.RealOutput drive_left_tau(unit = "N.m") = robot.drive_leftAxis.tau
    "What the drive of joint \"drive_left\" has to give"
    annotation (Placement(transformation(extent={{340, 180}, {360, 200}}), iconTransformation(extent={{100, 147}, {116, 163}})));

  Modelica.Mechanics.Rotational.Sources.Speed drive_leftDrive(
    useSupport = true,
    exact = false,
    phi(start = robot.drive_left.phi_start))
    "Moves joint \"drive_left\", through a filter"
    annotation (Placement(transformation(extent={{-40, 180}, {-20, 200}})));

  Modelica.Blocks.Interfaces.RealInput drive_right_w(unit = "rad/s")
    "How fast joint \"drive_right\" is to go"
    annotation (Placement(transformation(extent={{-140, 150}, {-120, 170}}), iconTransformation(extent={{-116, 127}, {-100, 143}})));

  Modelica.Blocks.Interfaces.RealOutput drive_right_tau(unit = "N.m") = robot.drive_rightAxis.tau
    "What the drive of joint \"drive_right\" has to give"
    annotation (Placement(transformation(extent={{340, 150}, {360, 170}}), iconTransformation(extent={{100, 127}, {116, 143}})));

  Modelica.Mechanics.Rotational.Sources.Speed drive_rightDrive(
    useSupport = true,
    exact = false,
    phi(start = robot.drive_right.phi_start))
    "Moves joint \"drive_right\", through a filter"
    annotation (Placement(transformation(extent={{-40, 150}, {-20, 170}})));

  Modelica.Blocks.Interfaces.RealInput lift_s(unit = "m")
    "Where joint \"lift\" is to go"
    annotation (Placement(transformation(extent={{-140, 330}, {-120, 350}}), iconTransformation(extent={{-116, 247}, {-100, 263}})));

  Modelica.Blocks.Interfaces.RealOutput lift_f(unit = "N") = robot.liftAxis.f
    "What the drive of joint \"lift\" has to give"
    annotation (Placement(transformation(extent={{340, 330}, {360, 350}}), iconTransformation(extent={{100, 247}, {116, 263}})));

  Modelica.Mechanics.Translational.Sources.Position liftDrive(
    useSupport = true,
    exact = false,
    v(fixed = true))
    "Moves joint \"lift\", through a filter"
    annotation (Placement(transformation(extent={{-40, 330}, {-20, 350}})));

  Modelica.Blocks.Interfaces.RealInput head_pan_phi(unit = "rad")
    "Where joint \"head_pan\" is to go"
    annotation (Placement(transformation(extent={{-140, 270}, {-120, 290}}), iconTransformation(extent={{-116, 207}, {-100, 223}})));

  Modelica.Blocks.Interfaces.RealOutput head_pan_tau(unit = "N.m") = robot.head_panAxis.tau
    "What the drive of joint \"head_pan\" has to give"
    annotation (Placement(transformation(extent={{340, 270}, {360, 290}}), iconTransformation(extent={{100, 207}, {116, 223}})));

  Modelica.Mechanics.Rotational.Sources.Position head_panDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"head_pan\", through a filter"
    annotation (Placement(transformation(extent={{-40, 270}, {-20, 290}})));

  Modelica.Blocks.Interfaces.RealInput head_tilt_phi(unit = "rad")
    "Where joint \"head_tilt\" is to go"
    annotation (Placement(transformation(extent={{-140, 300}, {-120, 320}}), iconTransformation(extent={{-116, 227}, {-100, 243}})));

  Modelica.Blocks.Interfaces.RealOutput head_tilt_tau(unit = "N.m") = robot.head_tiltAxis.tau
    "What the drive of joint \"head_tilt\" has to give"
    annotation (Placement(transformation(extent={{340, 300}, {360, 320}}), iconTransformation(extent={{100, 227}, {116, 243}})));

  Modelica.Mechanics.Rotational.Sources.Position head_tiltDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"head_tilt\", through a filter"
    annotation (Placement(transformation(extent={{-40, 300}, {-20, 320}})));

  Modelica.Blocks.Interfaces.RealInput lidar_spin_phi(unit = "rad")
    "Where joint \"lidar_spin\" is to go"
    annotation (Placement(transformation(extent={{-140, 120}, {-120, 140}}), iconTransformation(extent={{-116, 107}, {-100, 123}})));

  Modelica.Blocks.Interfaces.RealOutput lidar_spin_tau(unit = "N.m") = robot.lidar_spinAxis.tau
    "What the drive of joint \"lidar_spin\" has to give"
    annotation (Placement(transformation(extent={{340, 120}, {360, 140}}), iconTransformation(extent={{100, 107}, {116, 123}})));

  Modelica.Mechanics.Rotational.Sources.Position lidar_spinDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"lidar_spin\", through a filter"
    annotation (Placement(transformation(extent={{-40, 120}, {-20, 140}})));

equation
  connect(base.frame_b, robot.frame_a)
    annotation (Line(points={{-40, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_left_w, drive_leftDrive.w_ref)
    annotation (Line(points={{-130, 190}, {-42, 190}}, color={0, 0, 127}));
  connect(drive_leftDrive.flange, robot.drive_leftAxis)
    annotation (Line(points={{-20, 190}, {20, 190}}, color={0, 0, 0}));
  connect(drive_leftDrive.support, robot.drive_leftSupport)
    annotation (Line(points={{-30, 180}, {-30, 175}, {20, 175}}, color={0, 0, 0}));
  connect(drive_right_w, drive_rightDrive.w_ref)
    annotation (Line(points={{-130, 160}, {-42, 160}}, color={0, 0, 127}));
  connect(drive_rightDrive.flange, robot.drive_rightAxis)
    annotation (Line(points={{-20, 160}, {20, 160}}, color={0, 0, 0}));
  connect(drive_rightDrive.support, robot.drive_rightSupport)
    annotation (Line(points={{-30, 150}, {-30, 145}, {20, 145}}, color={0, 0, 0}));
  connect(lift_s, liftDrive.s_ref)
    annotation (Line(points={{-130, 340}, {-42, 340}}, color={0, 0, 127}));
  connect(liftDrive.flange, robot.liftAxis)
    annotation (Line(points={{-20, 340}, {20, 340}}, color={0, 127, 0}));
  connect(liftDrive.support, robot.liftSupport)
    annotation (Line(points={{-30, 330}, {-30, 325}, {20, 325}}, color={0, 127, 0}));
  connect(head_pan_phi, head_panDrive.phi_ref)
    annotation (Line(points={{-130, 280}, {-42, 280}}, color={0, 0, 127}));
  connect(head_panDrive.flange, robot.head_panAxis)
    annotation (Line(points={{-20, 280}, {20, 280}}, color={0, 0, 0}));
  connect(head_panDrive.support, robot.head_panSupport)
    annotation (Line(points={{-30, 270}, {-30, 265}, {20, 265}}, color={0, 0, 0}));
  connect(head_tilt_phi, head_tiltDrive.phi_ref)
    annotation (Line(points={{-130, 310}, {-42, 310}}, color={0, 0, 127}));
  connect(head_tiltDrive.flange, robot.head_tiltAxis)
    annotation (Line(points={{-20, 310}, {20, 310}}, color={0, 0, 0}));
  connect(head_tiltDrive.support, robot.head_tiltSupport)
    annotation (Line(points={{-30, 300}, {-30, 295}, {20, 295}}, color={0, 0, 0}));
  connect(lidar_spin_phi, lidar_spinDrive.phi_ref)
    annotation (Line(points={{-130, 130}, {-42, 130}}, color={0, 0, 127}));
  connect(lidar_spinDrive.flange, robot.lidar_spinAxis)
    annotation (Line(points={{-20, 130}, {20, 130}}, color={0, 0, 0}));
  connect(lidar_spinDrive.support, robot.lidar_spinSupport)
    annotation (Line(points={{-30, 120}, {-30, 115}, {20, 115}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 270}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 270}}, lineColor={110, 110, 110}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-94, 146}, {94, 164}}, textColor={64, 64, 64}, textString="drive_left"),
      Text(extent={{-94, 126}, {94, 144}}, textColor={64, 64, 64}, textString="drive_right"),
      Text(extent={{-94, 246}, {94, 264}}, textColor={64, 64, 64}, textString="lift"),
      Text(extent={{-94, 206}, {94, 224}}, textColor={64, 64, 64}, textString="head_pan"),
      Text(extent={{-94, 226}, {94, 244}}, textColor={64, 64, 64}, textString="head_tilt"),
      Text(extent={{-94, 106}, {94, 124}}, textColor={64, 64, 64}, textString="lidar_spin")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 375}})),
    Documentation(info="<html>
<p>
Robot WheeledRobot in its world, with one input per axis: its position, velocity or effort, as the source or the configuration commands it. Positions and velocities are filtered, so that they need no derivatives, and have an output for what the drive has to give; where the input is that, the outputs are position and velocity. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-ca32", base = "c8ebfffa26aee7ff"));
end WheeledRobotRun;
