within Arm;

model ArmTest "Quick check of robot Arm: every axis moves inside its limits"
  extends UrdfSync.Robots.PartialBench;
  extends Modelica.Icons.Example;

  replaceable Arm robot
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 235}})));

  UrdfSync.Drives.RotationalSweep shoulderDrive(
    phi_start = robot.shoulder.phi_start,
    phi_min = robot.shoulder.phi_min,
    phi_max = robot.shoulder.phi_max,
    w_max = robot.shoulder.w_max)
    "Moves joint \"shoulder\" there and back"
    annotation (Placement(transformation(extent={{-40, 120}, {-20, 140}})));

  UrdfSync.Drives.RotationalSweep elbowDrive(
    phi_start = robot.elbow.phi_start,
    phi_min = robot.elbow.phi_min,
    phi_max = robot.elbow.phi_max,
    w_max = robot.elbow.w_max)
    "Moves joint \"elbow\" there and back"
    annotation (Placement(transformation(extent={{-40, 210}, {-20, 230}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(shoulderDrive.flange, robot.shoulderAxis)
    annotation (Line(points={{-20, 130}, {20, 130}}, color={0, 0, 0}));
  connect(shoulderDrive.support, robot.shoulderSupport)
    annotation (Line(points={{-30, 120}, {-30, 115}, {20, 115}}, color={0, 0, 0}));
  connect(elbowDrive.flange, robot.elbowAxis)
    annotation (Line(points={{-20, 220}, {20, 220}}, color={0, 0, 0}));
  connect(elbowDrive.support, robot.elbowSupport)
    annotation (Line(points={{-30, 210}, {-30, 205}, {20, 205}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-120, -280}, {340, 255}})),
    Documentation(info="<html>
<p>
Simulates without inputs: every axis of robot Arm moves inside its limits and comes back. A warning in the log names a joint that passes one of its limits all the same, for example that of its effort. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-5e01", base = "ec575d6b0172c7c3"));
end ArmTest;
