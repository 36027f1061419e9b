within UrdfSync.Examples.FourBar;

model FourBarTest "Quick check of robot FourBar: every axis moves inside its limits"
  extends UrdfSync.Robots.PartialBench;
  extends Modelica.Icons.Example;

  replaceable FourBar robot
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 235}})));

  UrdfSync.Drives.RotationalSweep crank_pivotDrive(
    phi_start = robot.crank_pivot.phi_start,
    phi_min = robot.crank_pivot.phi_min,
    phi_max = robot.crank_pivot.phi_max,
    w_max = robot.crank_pivot.w_max,
    reach = robot.startPositions.crank_pivotReach)
    "Moves joint \"crank_pivot\" there and back"
    annotation (Placement(transformation(extent={{-40, 120}, {-20, 140}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(crank_pivotDrive.flange, robot.crank_pivotAxis)
    annotation (Line(points={{-20, 130}, {20, 130}}, color={0, 0, 0}));
  connect(crank_pivotDrive.support, robot.crank_pivotSupport)
    annotation (Line(points={{-30, 120}, {-30, 115}, {20, 115}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-8),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-120, -280}, {340, 255}})),
    Documentation(info="<html>
<p>
Simulates without inputs: every axis of robot FourBar moves inside its limits and comes back. A warning in the log names a joint that passes one of its limits all the same, for example that of its effort. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-5e01", base = "6e597c01493d321c"));
end FourBarTest;
