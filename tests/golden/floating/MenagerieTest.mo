within Zoo.Menagerie;

model MenagerieTest "Quick check of robot Menagerie: every axis moves inside its limits"
  extends UrdfSync.Robots.PartialMobileBench(
    redeclare MenagerieStance stance,
    load = robot.m*world.g);
  extends Modelica.Icons.Example;

  replaceable Menagerie robot
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 505}})));

  UrdfSync.Drives.TranslationalSweep liftDrive(
    s_start = robot.lift.s_start,
    s_min = robot.lift.s_min,
    s_max = robot.lift.s_max,
    v_max = robot.lift.v_max)
    "Moves joint \"lift\" there and back"
    annotation (Placement(transformation(extent={{-40, 120}, {-20, 140}})));

  UrdfSync.Drives.RotationalSweep rotationalDrive(
    phi_start = robot.rotational.phi_start,
    phi_min = robot.rotational.phi_min,
    phi_max = robot.rotational.phi_max,
    w_max = robot.rotational.w_max)
    "Moves joint \"rotational\" there and back"
    annotation (Placement(transformation(extent={{-40, 210}, {-20, 230}})));

  UrdfSync.Drives.RotationalSweep shoulderDrive(
    phi_start = robot.shoulder.phi_start,
    phi_min = robot.shoulder.phi_min,
    phi_max = robot.shoulder.phi_max,
    w_max = robot.shoulder.w_max)
    "Moves joint \"shoulder\" there and back"
    annotation (Placement(transformation(extent={{-40, 150}, {-20, 170}})));

equation
  connect(base.frame_b, robot.frame_a)
    annotation (Line(points={{-40, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(liftDrive.flange, robot.liftAxis)
    annotation (Line(points={{-20, 130}, {20, 130}}, color={0, 127, 0}));
  connect(liftDrive.support, robot.liftSupport)
    annotation (Line(points={{-30, 120}, {-30, 115}, {20, 115}}, color={0, 127, 0}));
  connect(rotationalDrive.flange, robot.rotationalAxis_2)
    annotation (Line(points={{-20, 220}, {20, 220}}, color={0, 0, 0}));
  connect(rotationalDrive.support, robot.rotationalSupport_2)
    annotation (Line(points={{-30, 210}, {-30, 205}, {20, 205}}, color={0, 0, 0}));
  connect(shoulderDrive.flange, robot.shoulderAxis)
    annotation (Line(points={{-20, 160}, {20, 160}}, color={0, 0, 0}));
  connect(shoulderDrive.support, robot.shoulderSupport)
    annotation (Line(points={{-30, 150}, {-30, 145}, {20, 145}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-120, -280}, {340, 525}})),
    Documentation(info="<html>
<p>
Simulates without inputs: every axis of robot Menagerie moves inside its limits and comes back. A warning in the log names a joint that passes one of its limits all the same, for example that of its effort. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end MenagerieTest;
