within Arm;

model ArmRun "Run robot Arm with positions from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialBench;

  parameter ArmParameters parameters
    "Numbers of the whole robot"
    annotation (Placement(transformation(extent={{80, 80}, {100, 100}})));

  Arm robot(fixedStart = false)
    "The robot"
    annotation (Placement(transformation(extent={{20, -60}, {60, -20}})));

  Modelica.Mechanics.Rotational.Sources.Position rotationalDrive[1](
    each useSupport = true,
    each exact = false,
    w(each fixed = true))
    "Moves, through a filter, each axis as asked"
    annotation (Placement(transformation(extent={{-20, 20}, {0, 40}})));

  Modelica.Blocks.Interfaces.RealInput phi[1](each unit = "rad")
    "Where each axis is to go, in the order of robot.rotationalAxis"
    annotation (Placement(transformation(extent={{-140, 10}, {-100, 50}})));

  Modelica.Blocks.Interfaces.RealOutput tau[1](each unit = "N.m") = robot.rotationalAxis.tau
    "What each drive has to give"
    annotation (Placement(transformation(extent={{100, 20}, {120, 40}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {0, -50}, {0, -40}, {20, -40}}, color={95, 95, 95}, thickness=0.5));
  connect(rotationalDrive.flange, robot.rotationalAxis)
    annotation (Line(points={{0, 30}, {28, 30}, {28, -20}}, color={0, 0, 0}));
  connect(rotationalDrive.support, robot.rotationalSupport)
    annotation (Line(points={{-10, 20}, {-10, 10}, {34, 10}, {34, -20}}, color={0, 0, 0}));
  connect(phi, rotationalDrive.phi_ref)
    annotation (Line(points={{-120, 30}, {-22, 30}}, color={0, 0, 127}));

  annotation (
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -100}, {120, 100}})),
    Documentation(info="<html>
<p>
Robot Arm in its world, with one input per axis for its position and one output for what its drive has to give. The inputs are filtered, so that they need no derivatives. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end ArmRun;
