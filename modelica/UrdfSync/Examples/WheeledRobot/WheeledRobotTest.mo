within UrdfSync.Examples.WheeledRobot;

model WheeledRobotTest "Quick check of robot WheeledRobot: every axis moves inside its limits"
  extends UrdfSync.Robots.PartialMobileBench(
    redeclare WheeledRobotStance stance,
    load = robot.m*world.g);
  extends Modelica.Icons.Example;

  replaceable WheeledRobot robot
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 355}})));

  UrdfSync.Drives.RotationalSweep drive_leftDrive(
    phi_start = robot.drive_left.phi_start,
    phi_min = robot.drive_left.phi_min,
    phi_max = robot.drive_left.phi_max,
    w_max = robot.drive_left.w_max)
    "Moves joint \"drive_left\" there and back"
    annotation (Placement(transformation(extent={{-40, 180}, {-20, 200}})));

  UrdfSync.Drives.RotationalSweep drive_rightDrive(
    phi_start = robot.drive_right.phi_start,
    phi_min = robot.drive_right.phi_min,
    phi_max = robot.drive_right.phi_max,
    w_max = robot.drive_right.w_max)
    "Moves joint \"drive_right\" there and back"
    annotation (Placement(transformation(extent={{-40, 150}, {-20, 170}})));

  UrdfSync.Drives.TranslationalSweep liftDrive(
    s_start = robot.lift.s_start,
    s_min = robot.lift.s_min,
    s_max = robot.lift.s_max,
    v_max = robot.lift.v_max)
    "Moves joint \"lift\" there and back"
    annotation (Placement(transformation(extent={{-40, 330}, {-20, 350}})));

  UrdfSync.Drives.RotationalSweep head_panDrive(
    phi_start = robot.head_pan.phi_start,
    phi_min = robot.head_pan.phi_min,
    phi_max = robot.head_pan.phi_max,
    w_max = robot.head_pan.w_max)
    "Moves joint \"head_pan\" there and back"
    annotation (Placement(transformation(extent={{-40, 270}, {-20, 290}})));

  UrdfSync.Drives.RotationalSweep head_tiltDrive(
    phi_start = robot.head_tilt.phi_start,
    phi_min = robot.head_tilt.phi_min,
    phi_max = robot.head_tilt.phi_max,
    w_max = robot.head_tilt.w_max)
    "Moves joint \"head_tilt\" there and back"
    annotation (Placement(transformation(extent={{-40, 300}, {-20, 320}})));

  UrdfSync.Drives.RotationalSweep lidar_spinDrive(
    phi_start = robot.lidar_spin.phi_start,
    phi_min = robot.lidar_spin.phi_min,
    phi_max = robot.lidar_spin.phi_max,
    w_max = robot.lidar_spin.w_max)
    "Moves joint \"lidar_spin\" there and back"
    annotation (Placement(transformation(extent={{-40, 120}, {-20, 140}})));

equation
  connect(base.frame_b, robot.frame_a)
    annotation (Line(points={{-40, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_leftDrive.flange, robot.drive_leftAxis)
    annotation (Line(points={{-20, 190}, {20, 190}}, color={0, 0, 0}));
  connect(drive_leftDrive.support, robot.drive_leftSupport)
    annotation (Line(points={{-30, 180}, {-30, 175}, {20, 175}}, color={0, 0, 0}));
  connect(drive_rightDrive.flange, robot.drive_rightAxis)
    annotation (Line(points={{-20, 160}, {20, 160}}, color={0, 0, 0}));
  connect(drive_rightDrive.support, robot.drive_rightSupport)
    annotation (Line(points={{-30, 150}, {-30, 145}, {20, 145}}, color={0, 0, 0}));
  connect(liftDrive.flange, robot.liftAxis)
    annotation (Line(points={{-20, 340}, {20, 340}}, color={0, 127, 0}));
  connect(liftDrive.support, robot.liftSupport)
    annotation (Line(points={{-30, 330}, {-30, 325}, {20, 325}}, color={0, 127, 0}));
  connect(head_panDrive.flange, robot.head_panAxis)
    annotation (Line(points={{-20, 280}, {20, 280}}, color={0, 0, 0}));
  connect(head_panDrive.support, robot.head_panSupport)
    annotation (Line(points={{-30, 270}, {-30, 265}, {20, 265}}, color={0, 0, 0}));
  connect(head_tiltDrive.flange, robot.head_tiltAxis)
    annotation (Line(points={{-20, 310}, {20, 310}}, color={0, 0, 0}));
  connect(head_tiltDrive.support, robot.head_tiltSupport)
    annotation (Line(points={{-30, 300}, {-30, 295}, {20, 295}}, color={0, 0, 0}));
  connect(lidar_spinDrive.flange, robot.lidar_spinAxis)
    annotation (Line(points={{-20, 130}, {20, 130}}, color={0, 0, 0}));
  connect(lidar_spinDrive.support, robot.lidar_spinSupport)
    annotation (Line(points={{-30, 120}, {-30, 115}, {20, 115}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-120, -280}, {340, 375}})),
    Documentation(info="<html>
<p>
Simulates without inputs: every axis of robot WheeledRobot moves inside its limits and comes back. A warning in the log names a joint that passes one of its limits all the same, for example that of its effort. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-5e01", base = "e17038061b1fdc81"));
end WheeledRobotTest;
