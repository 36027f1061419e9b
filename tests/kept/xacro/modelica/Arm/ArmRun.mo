within Arm;

model ArmRun "Run robot Arm with positions from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialBench;

  replaceable Arm robot(
    fixedStart = false)
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 145}})));

  Modelica.Blocks.Interfaces.RealInput to_upper_phi(unit = "rad")
    "Where joint \"to_upper\" is to go"
    annotation (Placement(transformation(extent={{-140, 120}, {-120, 140}}), iconTransformation(extent={{-116, 107}, {-100, 123}})));

  Modelica.Blocks.Interfaces.RealOutput to_upper_tau(unit = "N.m") = robot.to_upperAxis.tau
    "What the drive of joint \"to_upper\" has to give"
    annotation (Placement(transformation(extent={{340, 120}, {360, 140}}), iconTransformation(extent={{100, 107}, {116, 123}})));

  Modelica.Mechanics.Rotational.Sources.Position to_upperDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"to_upper\", through a filter"
    annotation (Placement(transformation(extent={{-40, 120}, {-20, 140}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(to_upper_phi, to_upperDrive.phi_ref)
    annotation (Line(points={{-130, 130}, {-42, 130}}, color={0, 0, 127}));
  connect(to_upperDrive.flange, robot.to_upperAxis)
    annotation (Line(points={{-20, 130}, {20, 130}}, color={0, 0, 0}));
  connect(to_upperDrive.support, robot.to_upperSupport)
    annotation (Line(points={{-30, 120}, {-30, 115}, {20, 115}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 130}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 130}}, lineColor={110, 110, 110}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-94, 106}, {94, 124}}, textColor={64, 64, 64}, textString="to_upper")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 165}})),
    Documentation(info="<html>
<p>
Robot Arm in its world, with one input per axis for its position and one output for what its drive has to give. The inputs are filtered, so that they need no derivatives. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-ca32", base = "edb52fd4f634e81d"));
end ArmRun;
