within Arm;

model ArmGeneric "Robot Arm from its record alone: every axis moves inside its limits"
  extends UrdfSync.Robots.PartialBench;
  extends Modelica.Icons.Example;

  UrdfSync.Robots.GenericRobot robot(
    redeclare parameter ArmParameters data,
    fixedStart = false)
    "The robot"
    annotation (Placement(transformation(extent={{20, -60}, {60, -20}})));

  Modelica.Mechanics.Rotational.Sources.Position rotationalDrive[1](
    each useSupport = true,
    each exact = true)
    "Moves each axis that turns as asked"
    annotation (Placement(transformation(extent={{-20, 20}, {0, 40}})));

  UrdfSync.Robots.AxisSweeps rotationalSweep(
    n = 1,
    start = robot.phi_start,
    lower = robot.phi_min,
    upper = robot.phi_max,
    velocity = robot.w_max,
    reach = 1)
    "There and back, by up to 1 rad"
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
Robot Arm as <code>UrdfSync.Robots.GenericRobot</code> reads it from its record. It simulates without inputs: every axis moves inside its limits and comes back. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-fc1a", base = "0446662aa8d0fd35"));
// mine
end ArmGeneric;
