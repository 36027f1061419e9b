within UrdfSync.Examples.FourBar;

model FourBarRun "Run robot FourBar with positions from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialBench;

  replaceable FourBar robot(
    fixedStart = false)
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 235}})));

  Modelica.Blocks.Interfaces.RealInput crank_pivot_phi(unit = "rad", start = robot.crank_pivot.phi_start)
    "Where joint \"crank_pivot\" is to go"
    annotation (Placement(transformation(extent={{-140, 120}, {-120, 140}}), iconTransformation(extent={{-116, 107}, {-100, 123}})));

  Modelica.Blocks.Interfaces.RealOutput crank_pivot_tau(unit = "N.m") = robot.crank_pivotAxis.tau
    "What the drive of joint \"crank_pivot\" has to give"
    annotation (Placement(transformation(extent={{340, 120}, {360, 140}}), iconTransformation(extent={{100, 107}, {116, 123}})));

  Modelica.Mechanics.Rotational.Sources.Position crank_pivotDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"crank_pivot\", through a filter"
    annotation (Placement(transformation(extent={{-40, 120}, {-20, 140}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(crank_pivot_phi, crank_pivotDrive.phi_ref)
    annotation (Line(points={{-130, 130}, {-42, 130}}, color={0, 0, 127}));
  connect(crank_pivotDrive.flange, robot.crank_pivotAxis)
    annotation (Line(points={{-20, 130}, {20, 130}}, color={0, 0, 0}));
  connect(crank_pivotDrive.support, robot.crank_pivotSupport)
    annotation (Line(points={{-30, 120}, {-30, 115}, {20, 115}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-8),
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 190}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 190}}, lineColor={110, 110, 110}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-94, 106}, {94, 124}}, textColor={64, 64, 64}, textString="crank_pivot")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 255}})),
    Documentation(info="<html>
<p>
Robot FourBar in its world, with one input per axis for its position and one output for what its drive has to give. The inputs are filtered, so that they need no derivatives. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-ca32", base = "07bb21f1b79c3ac7"));
end FourBarRun;
