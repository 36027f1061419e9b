within UrdfSync.Examples.FourBar;

model FourBarRun "Run robot FourBar with positions from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialBench;

  replaceable FourBar robot(
    fixedStart = false)
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 205}})));

  Modelica.Blocks.Interfaces.RealInput crank_pivot_phi(unit = "rad", start = robot.crank_pivot.phi_start)
    "Where joint \"crank_pivot\" is to go"
    annotation (Placement(transformation(extent={{-140, 180}, {-120, 200}}), iconTransformation(extent={{-116, 147}, {-100, 163}})));

  Modelica.Blocks.Interfaces.RealOutput crank_pivot_tau(unit = "N.m") = robot.crank_pivotAxis.tau
    "What the drive of joint \"crank_pivot\" has to give"
    annotation (Placement(transformation(extent={{340, 180}, {360, 200}}), iconTransformation(extent={{100, 147}, {116, 163}})));

  Modelica.Mechanics.Rotational.Sources.Position crank_pivotDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"crank_pivot\", through a filter"
    annotation (Placement(transformation(extent={{-40, 180}, {-20, 200}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(crank_pivot_phi, crank_pivotDrive.phi_ref)
    annotation (Line(points={{-130, 190}, {-42, 190}}, color={0, 0, 127}));
  connect(crank_pivotDrive.flange, robot.crank_pivotAxis)
    annotation (Line(points={{-20, 190}, {20, 190}}, color={0, 0, 0}));
  connect(crank_pivotDrive.support, robot.crank_pivotSupport)
    annotation (Line(points={{-30, 180}, {-30, 175}, {20, 175}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-8),
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 170}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 170}}, lineColor={110, 110, 110}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-94, 146}, {94, 164}}, textColor={64, 64, 64}, textString="crank_pivot")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 225}})),
    Documentation(info="<html>
<p>
Robot FourBar in its world, with one input per axis for its position and one output for what its drive has to give. The inputs are filtered, so that they need no derivatives. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end FourBarRun;
