within Arm;

model ArmTest "Quick check of robot Arm: every axis moves inside its limits"
  extends UrdfSync.Robots.PartialBench;
  extends Modelica.Icons.Example;

  parameter ArmParameters parameters
    "Numbers of the whole robot"
    annotation (Placement(transformation(extent={{80, 80}, {100, 100}})));

  Arm robot(fixedStart = false)
    "The robot"
    annotation (Placement(transformation(extent={{20, -60}, {60, -20}})));

  Modelica.Mechanics.Rotational.Sources.Position rotationalDrive[1](
    each useSupport = true,
    each exact = true)
    "Moves each axis as asked"
    annotation (Placement(transformation(extent={{-20, 20}, {0, 40}})));

  UrdfSync.Robots.Sweep rotationalSweep(
    n = 1,
    start = robot.phi_start,
    range = robot.rotationalRange,
    reach = 1)
    "There and back"
    annotation (Placement(transformation(extent={{-60, 20}, {-40, 40}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {0, -50}, {0, -40}, {20, -40}}, color={95, 95, 95}, thickness=0.5));
  connect(rotationalDrive.flange, robot.rotationalAxis)
    annotation (Line(points={{0, 30}, {28, 30}, {28, -20}}, color={0, 0, 0}));
  connect(rotationalDrive.support, robot.rotationalSupport)
    annotation (Line(points={{-10, 20}, {-10, 10}, {34, 10}, {34, -20}}, color={0, 0, 0}));
  connect(rotationalSweep.y, rotationalDrive.phi_ref)
    annotation (Line(points={{-39, 30}, {-22, 30}}, color={0, 0, 127}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Documentation(info="<html>
<p>
Simulates without inputs: every axis of robot Arm moves inside its limits and comes back. A warning in the log names a joint that passes one of its limits all the same, for example that of its effort. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end ArmTest;
