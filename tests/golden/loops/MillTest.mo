within Zoo.Mill;

model MillTest "Quick check of robot Mill: every axis moves inside its limits"
  extends UrdfSync.Robots.PartialMobileBench(
    redeclare MillStance stance,
    load = robot.m*world.g);
  extends Modelica.Icons.Example;

  replaceable Mill robot
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 295}})));

  UrdfSync.Drives.RotationalSweep crankDrive(
    phi_start = robot.crank.phi_start,
    phi_min = robot.crank.phi_min,
    phi_max = robot.crank.phi_max,
    w_max = robot.crank.w_max,
    reach = robot.startPositions.crankReach)
    "Moves joint \"crank\" there and back"
    annotation (Placement(transformation(extent={{-40, 270}, {-20, 290}})));

  UrdfSync.Drives.TranslationalSweep ramDrive(
    s_start = robot.ram.s_start,
    s_min = robot.ram.s_min,
    s_max = robot.ram.s_max,
    v_max = robot.ram.v_max,
    reach = robot.startPositions.ramReach)
    "Moves joint \"ram\" there and back"
    annotation (Placement(transformation(extent={{-40, 210}, {-20, 230}})));

equation
  connect(base.frame_b, robot.frame_a)
    annotation (Line(points={{-40, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(crankDrive.flange, robot.crankAxis)
    annotation (Line(points={{-20, 280}, {20, 280}}, color={0, 0, 0}));
  connect(crankDrive.support, robot.crankSupport)
    annotation (Line(points={{-30, 270}, {-30, 265}, {20, 265}}, color={0, 0, 0}));
  connect(ramDrive.flange, robot.ramAxis)
    annotation (Line(points={{-20, 220}, {20, 220}}, color={0, 127, 0}));
  connect(ramDrive.support, robot.ramSupport)
    annotation (Line(points={{-30, 210}, {-30, 205}, {20, 205}}, color={0, 127, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-8),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-120, -280}, {340, 315}})),
    Documentation(info="<html>
<p>
Simulates without inputs: every axis of robot Mill moves inside its limits and comes back. A warning in the log names a joint that passes one of its limits all the same, for example that of its effort. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end MillTest;
