within Arm;

model ArmRun "Run robot Arm with positions from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialBench;

  replaceable Arm robot(
    fixedStart = false)
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 235}})));

  Modelica.Blocks.Interfaces.RealInput shoulder_phi(unit = "rad")
    "Where joint \"shoulder\" is to go"
    annotation (Placement(transformation(extent={{-140, 120}, {-120, 140}}), iconTransformation(extent={{-116, 107}, {-100, 123}})));

  Modelica.Blocks.Interfaces.RealOutput shoulder_tau(unit = "N.m") = robot.shoulderAxis.tau
    "What the drive of joint \"shoulder\" has to give"
    annotation (Placement(transformation(extent={{340, 120}, {360, 140}}), iconTransformation(extent={{100, 107}, {116, 123}})));

  Modelica.Mechanics.Rotational.Sources.Position shoulderDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"shoulder\", through a filter"
    annotation (Placement(transformation(extent={{-40, 120}, {-20, 140}})));

  Modelica.Blocks.Interfaces.RealInput elbow_phi(unit = "rad")
    "Where joint \"elbow\" is to go"
    annotation (Placement(transformation(extent={{-140, 210}, {-120, 230}}), iconTransformation(extent={{-116, 167}, {-100, 183}})));

  Modelica.Blocks.Interfaces.RealOutput elbow_tau(unit = "N.m") = robot.elbowAxis.tau
    "What the drive of joint \"elbow\" has to give"
    annotation (Placement(transformation(extent={{340, 210}, {360, 230}}), iconTransformation(extent={{100, 167}, {116, 183}})));

  Modelica.Mechanics.Rotational.Sources.Position elbowDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"elbow\", through a filter"
    annotation (Placement(transformation(extent={{-40, 210}, {-20, 230}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(shoulder_phi, shoulderDrive.phi_ref)
    annotation (Line(points={{-130, 130}, {-42, 130}}, color={0, 0, 127}));
  connect(shoulderDrive.flange, robot.shoulderAxis)
    annotation (Line(points={{-20, 130}, {20, 130}}, color={0, 0, 0}));
  connect(shoulderDrive.support, robot.shoulderSupport)
    annotation (Line(points={{-30, 120}, {-30, 115}, {20, 115}}, color={0, 0, 0}));
  connect(elbow_phi, elbowDrive.phi_ref)
    annotation (Line(points={{-130, 220}, {-42, 220}}, color={0, 0, 127}));
  connect(elbowDrive.flange, robot.elbowAxis)
    annotation (Line(points={{-20, 220}, {20, 220}}, color={0, 0, 0}));
  connect(elbowDrive.support, robot.elbowSupport)
    annotation (Line(points={{-30, 210}, {-30, 205}, {20, 205}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 190}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 190}}, lineColor={110, 110, 110}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-94, 106}, {94, 124}}, textColor={64, 64, 64}, textString="shoulder"),
      Text(extent={{-94, 166}, {94, 184}}, textColor={64, 64, 64}, textString="elbow")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 255}})),
    Documentation(info="<html>
<p>
Robot Arm in its world, with one input per axis for its position and one output for what its drive has to give. The inputs are filtered, so that they need no derivatives. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-ca32", base = "e7058e7c32600085"));
end ArmRun;
