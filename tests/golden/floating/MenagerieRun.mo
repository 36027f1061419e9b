within Zoo.Menagerie;

model MenagerieRun "Run robot Menagerie with positions from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialMobileBench(
    redeclare MenagerieStance stance,
    load = robot.m*world.g);

  replaceable Menagerie robot(
    fixedStart = false)
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 385}})));

  Modelica.Blocks.Interfaces.RealInput lift_s(unit = "m")
    "Where joint \"lift\" is to go"
    annotation (Placement(transformation(extent={{-140, 360}, {-120, 380}}), iconTransformation(extent={{-116, 267}, {-100, 283}})));

  Modelica.Blocks.Interfaces.RealOutput lift_f(unit = "N") = robot.liftAxis.f
    "What the drive of joint \"lift\" has to give"
    annotation (Placement(transformation(extent={{340, 360}, {360, 380}}), iconTransformation(extent={{100, 267}, {116, 283}})));

  Modelica.Mechanics.Translational.Sources.Position liftDrive(
    useSupport = true,
    exact = false,
    v(fixed = true))
    "Moves joint \"lift\", through a filter"
    annotation (Placement(transformation(extent={{-40, 360}, {-20, 380}})));

  Modelica.Blocks.Interfaces.RealInput rotational_phi(unit = "rad")
    "Where joint \"rotational\" is to go"
    annotation (Placement(transformation(extent={{-140, 330}, {-120, 350}}), iconTransformation(extent={{-116, 247}, {-100, 263}})));

  Modelica.Blocks.Interfaces.RealOutput rotational_tau(unit = "N.m") = robot.rotationalAxis_2.tau
    "What the drive of joint \"rotational\" has to give"
    annotation (Placement(transformation(extent={{340, 330}, {360, 350}}), iconTransformation(extent={{100, 247}, {116, 263}})));

  Modelica.Mechanics.Rotational.Sources.Position rotationalDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"rotational\", through a filter"
    annotation (Placement(transformation(extent={{-40, 330}, {-20, 350}})));

  Modelica.Blocks.Interfaces.RealInput shoulder_phi(unit = "rad")
    "Where joint \"shoulder\" is to go"
    annotation (Placement(transformation(extent={{-140, 300}, {-120, 320}}), iconTransformation(extent={{-116, 227}, {-100, 243}})));

  Modelica.Blocks.Interfaces.RealOutput shoulder_tau(unit = "N.m") = robot.shoulderAxis.tau
    "What the drive of joint \"shoulder\" has to give"
    annotation (Placement(transformation(extent={{340, 300}, {360, 320}}), iconTransformation(extent={{100, 227}, {116, 243}})));

  Modelica.Mechanics.Rotational.Sources.Position shoulderDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"shoulder\", through a filter"
    annotation (Placement(transformation(extent={{-40, 300}, {-20, 320}})));

equation
  connect(base.frame_b, robot.frame_a)
    annotation (Line(points={{-40, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(lift_s, liftDrive.s_ref)
    annotation (Line(points={{-130, 370}, {-42, 370}}, color={0, 0, 127}));
  connect(liftDrive.flange, robot.liftAxis)
    annotation (Line(points={{-20, 370}, {20, 370}}, color={0, 127, 0}));
  connect(liftDrive.support, robot.liftSupport)
    annotation (Line(points={{-30, 360}, {-30, 355}, {20, 355}}, color={0, 127, 0}));
  connect(rotational_phi, rotationalDrive.phi_ref)
    annotation (Line(points={{-130, 340}, {-42, 340}}, color={0, 0, 127}));
  connect(rotationalDrive.flange, robot.rotationalAxis_2)
    annotation (Line(points={{-20, 340}, {20, 340}}, color={0, 0, 0}));
  connect(rotationalDrive.support, robot.rotationalSupport_2)
    annotation (Line(points={{-30, 330}, {-30, 325}, {20, 325}}, color={0, 0, 0}));
  connect(shoulder_phi, shoulderDrive.phi_ref)
    annotation (Line(points={{-130, 310}, {-42, 310}}, color={0, 0, 127}));
  connect(shoulderDrive.flange, robot.shoulderAxis)
    annotation (Line(points={{-20, 310}, {20, 310}}, color={0, 0, 0}));
  connect(shoulderDrive.support, robot.shoulderSupport)
    annotation (Line(points={{-30, 300}, {-30, 295}, {20, 295}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 290}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 290}}, lineColor={110, 110, 110}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-94, 266}, {94, 284}}, textColor={64, 64, 64}, textString="lift"),
      Text(extent={{-94, 246}, {94, 264}}, textColor={64, 64, 64}, textString="rotational"),
      Text(extent={{-94, 226}, {94, 244}}, textColor={64, 64, 64}, textString="shoulder")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 405}})),
    Documentation(info="<html>
<p>
Robot Menagerie in its world, with one input per axis for its position and one output for what its drive has to give. The inputs are filtered, so that they need no derivatives. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end MenagerieRun;
