within Arm;

model ArmTest "Quick check of robot Arm: every axis moves inside its limits"
  extends UrdfSync.Robots.PartialBench;
  extends Modelica.Icons.Example;

  replaceable Arm robot
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 145}})));

  UrdfSync.Drives.RotationalSweep to_upperDrive(
    phi_start = robot.to_upper.phi_start,
    phi_min = robot.to_upper.phi_min,
    phi_max = robot.to_upper.phi_max,
    w_max = robot.to_upper.w_max)
    "Moves joint \"to_upper\" there and back"
    annotation (Placement(transformation(extent={{-40, 120}, {-20, 140}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(to_upperDrive.flange, robot.to_upperAxis)
    annotation (Line(points={{-20, 130}, {20, 130}}, color={0, 0, 0}));
  connect(to_upperDrive.support, robot.to_upperSupport)
    annotation (Line(points={{-30, 120}, {-30, 115}, {20, 115}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-120, -280}, {340, 165}})),
    Documentation(info="<html>
<p>
Simulates without inputs: every axis of robot Arm moves inside its limits and comes back. A warning in the log names a joint that passes one of its limits all the same, for example that of its effort. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-5e01", base = "2b3667c7111912df"));
end ArmTest;
