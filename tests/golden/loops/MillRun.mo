within Zoo.Mill;

model MillRun "Run robot Mill with positions from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialMobileBench(
    redeclare MillStance stance,
    load = robot.m*world.g);

  replaceable Mill robot(
    fixedStart = false)
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 295}})));

  Modelica.Blocks.Interfaces.RealInput positions[2](unit = {"rad", "m"}, start = {robot.crank.phi_start, robot.ram.s_start})
    "Where the joints are to go, in the order of the chain: the documentation names them"
    annotation (Placement(transformation(extent={{-140, 270}, {-120, 290}}), iconTransformation(extent={{-140, -20}, {-100, 20}})));

  Modelica.Blocks.Interfaces.RealOutput crank_tau(unit = "N.m") = robot.crankAxis.tau
    "What the drive of joint \"crank\" has to give"
    annotation (Placement(transformation(extent={{340, 270}, {360, 290}}), iconTransformation(extent={{100, 207}, {116, 223}})));

  Modelica.Mechanics.Rotational.Sources.Position crankDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"crank\", through a filter"
    annotation (Placement(transformation(extent={{-40, 270}, {-20, 290}})));

  Modelica.Blocks.Interfaces.RealOutput ram_f(unit = "N") = robot.ramAxis.f
    "What the drive of joint \"ram\" has to give"
    annotation (Placement(transformation(extent={{340, 210}, {360, 230}}), iconTransformation(extent={{100, 167}, {116, 183}})));

  Modelica.Mechanics.Translational.Sources.Position ramDrive(
    useSupport = true,
    exact = false,
    v(fixed = true))
    "Moves joint \"ram\", through a filter"
    annotation (Placement(transformation(extent={{-40, 210}, {-20, 230}})));

equation
  connect(base.frame_b, robot.frame_a)
    annotation (Line(points={{-40, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(positions[1], crankDrive.phi_ref)
    annotation (Line(points={{-130, 280}, {-80, 280}, {-80, 280}, {-42, 280}}, color={0, 0, 127}));
  connect(crankDrive.flange, robot.crankAxis)
    annotation (Line(points={{-20, 280}, {20, 280}}, color={0, 0, 0}));
  connect(crankDrive.support, robot.crankSupport)
    annotation (Line(points={{-30, 270}, {-30, 265}, {20, 265}}, color={0, 0, 0}));
  connect(positions[2], ramDrive.s_ref)
    annotation (Line(points={{-130, 280}, {-80, 280}, {-80, 220}, {-42, 220}}, color={0, 0, 127}));
  connect(ramDrive.flange, robot.ramAxis)
    annotation (Line(points={{-20, 220}, {20, 220}}, color={0, 127, 0}));
  connect(ramDrive.support, robot.ramSupport)
    annotation (Line(points={{-30, 210}, {-30, 205}, {20, 205}}, color={0, 127, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-8),
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 230}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 230}}, lineColor={110, 110, 110}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-94, 206}, {94, 224}}, textColor={64, 64, 64}, textString="crank"),
      Text(extent={{-94, 166}, {94, 184}}, textColor={64, 64, 64}, textString="ram")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 315}})),
    Documentation(info="<html>
<p>
Robot Mill in its world, with one input per axis for its position and one output for what its drive has to give. The inputs are filtered, so that they need no derivatives. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
<p>
The elements of <code>positions</code> belong to these joints:
</p>
<ol>
<li><code>crank</code> (rad)</li>
<li><code>ram</code> (m)</li>
</ol>
</html>"));
end MillRun;
