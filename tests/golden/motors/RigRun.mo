within Rig;

model RigRun "Run robot Rig with commands from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialMobileBench(
    redeclare RigStance stance,
    load = robot.m*world.g);

  replaceable Rig robot(
    fixedStart = false,
    caster1(fixedStart = true),
    caster2(fixedStart = true),
    caster3(fixedStart = true),
    waist(fixedStart = true),
    lift(fixedStart = true))
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 475}})));

  Modelica.Blocks.Interfaces.RealInput commands[6](unit = {"N.m", "N", "m", "rad", "rad", "rad"}, start = {0, 0, 0, robot.tilt.phi_start, 0, 0})
    "What is given to the joints, in the order of the chain: the documentation names them"
    annotation (Placement(transformation(extent={{-140, 210}, {-120, 230}}), iconTransformation(extent={{-140, -20}, {-100, 20}})));

  Modelica.Blocks.Interfaces.RealOutput waist_phi(unit = "rad") = robot.waistAxis.phi - robot.waistSupport.phi
    "Where joint \"waist\" is"
    annotation (Placement(transformation(extent={{340, 220}, {350, 230}}), iconTransformation(extent={{100, 176}, {108, 184}})));

  Modelica.Blocks.Interfaces.RealOutput waist_w(unit = "rad/s") = der(waist_phi)
    "How fast joint \"waist\" is"
    annotation (Placement(transformation(extent={{340, 208}, {350, 218}}), iconTransformation(extent={{100, 166}, {108, 174}})));

  Modelica.Mechanics.Rotational.Sources.Torque waistDrive(useSupport = true)
    "Pushes joint \"waist\""
    annotation (Placement(transformation(extent={{-40, 210}, {-20, 230}})));

  Modelica.Blocks.Interfaces.RealOutput lift_s(unit = "m") = robot.liftAxis.s - robot.liftSupport.s
    "Where joint \"lift\" is"
    annotation (Placement(transformation(extent={{340, 340}, {350, 350}}), iconTransformation(extent={{100, 256}, {108, 264}})));

  Modelica.Blocks.Interfaces.RealOutput lift_v(unit = "m/s") = der(lift_s)
    "How fast joint \"lift\" is"
    annotation (Placement(transformation(extent={{340, 328}, {350, 338}}), iconTransformation(extent={{100, 246}, {108, 254}})));

  Modelica.Mechanics.Translational.Sources.Force liftDrive(useSupport = true)
    "Pushes joint \"lift\""
    annotation (Placement(transformation(extent={{-40, 330}, {-20, 350}})));

  Modelica.Blocks.Interfaces.RealOutput push_f(unit = "N") = robot.pushAxis.f
    "What the drive of joint \"push\" has to give"
    annotation (Placement(transformation(extent={{340, 270}, {360, 290}}), iconTransformation(extent={{100, 207}, {116, 223}})));

  Modelica.Mechanics.Translational.Sources.Position pushDrive(
    useSupport = true,
    exact = false,
    v(fixed = true))
    "Moves joint \"push\", through a filter"
    annotation (Placement(transformation(extent={{-40, 270}, {-20, 290}})));

  Modelica.Blocks.Interfaces.RealOutput tilt_tau(unit = "N.m") = robot.tiltAxis.tau
    "What the drive of joint \"tilt\" has to give"
    annotation (Placement(transformation(extent={{340, 240}, {360, 260}}), iconTransformation(extent={{100, 187}, {116, 203}})));

  Modelica.Mechanics.Rotational.Sources.Position tiltDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"tilt\", through a filter"
    annotation (Placement(transformation(extent={{-40, 240}, {-20, 260}})));

  Modelica.Blocks.Interfaces.RealOutput flex_tau(unit = "N.m") = robot.flexAxis.tau
    "What the drive of joint \"flex\" has to give"
    annotation (Placement(transformation(extent={{340, 180}, {360, 200}}), iconTransformation(extent={{100, 147}, {116, 163}})));

  Modelica.Mechanics.Rotational.Sources.Position flexDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"flex\", through a filter"
    annotation (Placement(transformation(extent={{-40, 180}, {-20, 200}})));

  Modelica.Blocks.Interfaces.RealOutput roll_tau(unit = "N.m") = robot.rollAxis.tau
    "What the drive of joint \"roll\" has to give"
    annotation (Placement(transformation(extent={{340, 150}, {360, 170}}), iconTransformation(extent={{100, 127}, {116, 143}})));

  Modelica.Mechanics.Rotational.Sources.Position rollDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"roll\", through a filter"
    annotation (Placement(transformation(extent={{-40, 150}, {-20, 170}})));

  Modelica.Blocks.Interfaces.RealOutput load_f[3](each unit = "N") = robot.load.f
    "Force that sensor \"load\" shows"
    annotation (Placement(transformation(extent={{340, 70}, {360, 90}}), iconTransformation(extent={{100, 86}, {108, 94}})));

  Modelica.Blocks.Interfaces.RealOutput load_t[3](each unit = "N.m") = robot.load.t
    "Torque that sensor \"load\" shows"
    annotation (Placement(transformation(extent={{340, 50}, {360, 70}}), iconTransformation(extent={{100, 76}, {108, 84}})));

equation
  connect(base.frame_b, robot.frame_a)
    annotation (Line(points={{-40, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  waistDrive.tau = UrdfSync.Functions.limitedEffort(
    commands[1],
    waist_w,
    robot.waist.parameters.limits.effort,
    robot.waist.parameters.limits.velocity);
  connect(waistDrive.flange, robot.waistAxis)
    annotation (Line(points={{-20, 220}, {20, 220}}, color={0, 0, 0}));
  connect(waistDrive.support, robot.waistSupport)
    annotation (Line(points={{-30, 210}, {-30, 205}, {20, 205}}, color={0, 0, 0}));
  liftDrive.f = UrdfSync.Functions.limitedEffort(
    commands[2],
    lift_v,
    robot.lift.parameters.limits.effort,
    robot.lift.parameters.limits.velocity);
  connect(liftDrive.flange, robot.liftAxis)
    annotation (Line(points={{-20, 340}, {20, 340}}, color={0, 127, 0}));
  connect(liftDrive.support, robot.liftSupport)
    annotation (Line(points={{-30, 330}, {-30, 325}, {20, 325}}, color={0, 127, 0}));
  connect(commands[3], pushDrive.s_ref)
    annotation (Line(points={{-130, 220}, {-80, 220}, {-80, 280}, {-42, 280}}, color={0, 0, 127}));
  connect(pushDrive.flange, robot.pushAxis)
    annotation (Line(points={{-20, 280}, {20, 280}}, color={0, 127, 0}));
  connect(pushDrive.support, robot.pushSupport)
    annotation (Line(points={{-30, 270}, {-30, 265}, {20, 265}}, color={0, 127, 0}));
  connect(commands[4], tiltDrive.phi_ref)
    annotation (Line(points={{-130, 220}, {-80, 220}, {-80, 250}, {-42, 250}}, color={0, 0, 127}));
  connect(tiltDrive.flange, robot.tiltAxis)
    annotation (Line(points={{-20, 250}, {20, 250}}, color={0, 0, 0}));
  connect(tiltDrive.support, robot.tiltSupport)
    annotation (Line(points={{-30, 240}, {-30, 235}, {20, 235}}, color={0, 0, 0}));
  connect(commands[5], flexDrive.phi_ref)
    annotation (Line(points={{-130, 220}, {-80, 220}, {-80, 190}, {-42, 190}}, color={0, 0, 127}));
  connect(flexDrive.flange, robot.flexAxis)
    annotation (Line(points={{-20, 190}, {20, 190}}, color={0, 0, 0}));
  connect(flexDrive.support, robot.flexSupport)
    annotation (Line(points={{-30, 180}, {-30, 175}, {20, 175}}, color={0, 0, 0}));
  connect(commands[6], rollDrive.phi_ref)
    annotation (Line(points={{-130, 220}, {-80, 220}, {-80, 160}, {-42, 160}}, color={0, 0, 127}));
  connect(rollDrive.flange, robot.rollAxis)
    annotation (Line(points={{-20, 160}, {20, 160}}, color={0, 0, 0}));
  connect(rollDrive.support, robot.rollSupport)
    annotation (Line(points={{-30, 150}, {-30, 145}, {20, 145}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 350}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 350}}, lineColor={110, 110, 110}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-94, 166}, {94, 184}}, textColor={64, 64, 64}, textString="waist"),
      Text(extent={{-94, 246}, {94, 264}}, textColor={64, 64, 64}, textString="lift"),
      Text(extent={{-94, 206}, {94, 224}}, textColor={64, 64, 64}, textString="push"),
      Text(extent={{-94, 186}, {94, 204}}, textColor={64, 64, 64}, textString="tilt"),
      Text(extent={{-94, 146}, {94, 164}}, textColor={64, 64, 64}, textString="flex"),
      Text(extent={{-94, 126}, {94, 144}}, textColor={64, 64, 64}, textString="roll")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 495}})),
    Documentation(info="<html>
<p>
Robot Rig in its world, with one input per axis: its position, velocity or effort, as the source or the configuration commands it. Positions and velocities are filtered, so that they need no derivatives, and have an output for what the drive has to give; where the input is that, the outputs are position and velocity. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
<p>
The elements of <code>commands</code> belong to these joints:
</p>
<ol>
<li><code>waist</code> (N.m)</li>
<li><code>lift</code> (N)</li>
<li><code>push</code> (m)</li>
<li><code>tilt</code> (rad)</li>
<li><code>flex</code> (rad)</li>
<li><code>roll</code> (rad)</li>
</ol>
</html>"));
end RigRun;
