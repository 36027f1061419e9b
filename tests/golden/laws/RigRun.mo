within Rig;

model RigRun "Run robot Rig with commands from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialBench;

  replaceable Rig robot(
    fixedStart = false,
    caster1(fixedStart = true),
    caster2(fixedStart = true),
    caster3(fixedStart = true),
    push(fixedStart = true),
    tilt(fixedStart = true))
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 475}})));

  Modelica.Blocks.Interfaces.RealInput waist_w(unit = "rad/s")
    "How fast joint \"waist\" is to go"
    annotation (Placement(transformation(extent={{-140, 210}, {-120, 230}}), iconTransformation(extent={{-116, 167}, {-100, 183}})));

  Modelica.Blocks.Interfaces.RealOutput waist_tau(unit = "N.m") = robot.waistAxis.tau
    "What the drive of joint \"waist\" has to give"
    annotation (Placement(transformation(extent={{340, 210}, {360, 230}}), iconTransformation(extent={{100, 167}, {116, 183}})));

  Modelica.Mechanics.Rotational.Sources.Speed waistDrive(
    useSupport = true,
    exact = false,
    phi(start = robot.waist.phi_start))
    "Moves joint \"waist\", through a filter"
    annotation (Placement(transformation(extent={{-40, 210}, {-20, 230}})));

  Modelica.Blocks.Interfaces.RealInput lift_v(unit = "m/s")
    "How fast joint \"lift\" is to go"
    annotation (Placement(transformation(extent={{-140, 330}, {-120, 350}}), iconTransformation(extent={{-116, 247}, {-100, 263}})));

  Modelica.Blocks.Interfaces.RealOutput lift_f(unit = "N") = robot.liftAxis.f
    "What the drive of joint \"lift\" has to give"
    annotation (Placement(transformation(extent={{340, 330}, {360, 350}}), iconTransformation(extent={{100, 247}, {116, 263}})));

  Modelica.Mechanics.Translational.Sources.Speed liftDrive(
    useSupport = true,
    exact = false,
    s(start = robot.lift.s_start))
    "Moves joint \"lift\", through a filter"
    annotation (Placement(transformation(extent={{-40, 330}, {-20, 350}})));

  Modelica.Blocks.Interfaces.RealInput push_f(unit = "N")
    "What the drive of joint \"push\" gives"
    annotation (Placement(transformation(extent={{-140, 270}, {-120, 290}}), iconTransformation(extent={{-116, 207}, {-100, 223}})));

  Modelica.Blocks.Interfaces.RealOutput push_s(unit = "m") = robot.pushAxis.s - robot.pushSupport.s
    "Where joint \"push\" is"
    annotation (Placement(transformation(extent={{340, 280}, {350, 290}}), iconTransformation(extent={{100, 216}, {108, 224}})));

  Modelica.Blocks.Interfaces.RealOutput push_v(unit = "m/s") = der(push_s)
    "How fast joint \"push\" is"
    annotation (Placement(transformation(extent={{340, 268}, {350, 278}}), iconTransformation(extent={{100, 206}, {108, 214}})));

  Modelica.Mechanics.Translational.Sources.Force pushDrive(useSupport = true)
    "Pushes joint \"push\""
    annotation (Placement(transformation(extent={{-40, 270}, {-20, 290}})));

  Modelica.Blocks.Interfaces.RealInput tilt_tau(unit = "N.m")
    "What the drive of joint \"tilt\" gives"
    annotation (Placement(transformation(extent={{-140, 240}, {-120, 260}}), iconTransformation(extent={{-116, 187}, {-100, 203}})));

  Modelica.Blocks.Interfaces.RealOutput tilt_phi(unit = "rad") = robot.tiltAxis.phi - robot.tiltSupport.phi
    "Where joint \"tilt\" is"
    annotation (Placement(transformation(extent={{340, 250}, {350, 260}}), iconTransformation(extent={{100, 196}, {108, 204}})));

  Modelica.Blocks.Interfaces.RealOutput tilt_w(unit = "rad/s") = der(tilt_phi)
    "How fast joint \"tilt\" is"
    annotation (Placement(transformation(extent={{340, 238}, {350, 248}}), iconTransformation(extent={{100, 186}, {108, 194}})));

  Modelica.Mechanics.Rotational.Sources.Torque tiltDrive(useSupport = true)
    "Pushes joint \"tilt\""
    annotation (Placement(transformation(extent={{-40, 240}, {-20, 260}})));

  Modelica.Blocks.Interfaces.RealInput flex_phi(unit = "rad")
    "Where joint \"flex\" is to go"
    annotation (Placement(transformation(extent={{-140, 180}, {-120, 200}}), iconTransformation(extent={{-116, 147}, {-100, 163}})));

  Modelica.Blocks.Interfaces.RealOutput flex_tau(unit = "N.m") = robot.flexAxis.tau
    "What the drive of joint \"flex\" has to give"
    annotation (Placement(transformation(extent={{340, 180}, {360, 200}}), iconTransformation(extent={{100, 147}, {116, 163}})));

  Modelica.Mechanics.Rotational.Sources.Position flexDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"flex\", through a filter"
    annotation (Placement(transformation(extent={{-40, 180}, {-20, 200}})));

  Modelica.Blocks.Interfaces.RealInput roll_phi(unit = "rad")
    "Where joint \"roll\" is to go"
    annotation (Placement(transformation(extent={{-140, 150}, {-120, 170}}), iconTransformation(extent={{-116, 127}, {-100, 143}})));

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
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(waist_w, waistDrive.w_ref)
    annotation (Line(points={{-130, 220}, {-42, 220}}, color={0, 0, 127}));
  connect(waistDrive.flange, robot.waistAxis)
    annotation (Line(points={{-20, 220}, {20, 220}}, color={0, 0, 0}));
  connect(waistDrive.support, robot.waistSupport)
    annotation (Line(points={{-30, 210}, {-30, 205}, {20, 205}}, color={0, 0, 0}));
  connect(lift_v, liftDrive.v_ref)
    annotation (Line(points={{-130, 340}, {-42, 340}}, color={0, 0, 127}));
  connect(liftDrive.flange, robot.liftAxis)
    annotation (Line(points={{-20, 340}, {20, 340}}, color={0, 127, 0}));
  connect(liftDrive.support, robot.liftSupport)
    annotation (Line(points={{-30, 330}, {-30, 325}, {20, 325}}, color={0, 127, 0}));
  pushDrive.f = UrdfSync.Functions.limitedEffort(
    push_f,
    push_v,
    robot.push.parameters.limits.effort,
    robot.push.parameters.limits.velocity);
  connect(pushDrive.flange, robot.pushAxis)
    annotation (Line(points={{-20, 280}, {20, 280}}, color={0, 127, 0}));
  connect(pushDrive.support, robot.pushSupport)
    annotation (Line(points={{-30, 270}, {-30, 265}, {20, 265}}, color={0, 127, 0}));
  connect(tilt_tau, tiltDrive.tau)
    annotation (Line(points={{-130, 250}, {-42, 250}}, color={0, 0, 127}));
  connect(tiltDrive.flange, robot.tiltAxis)
    annotation (Line(points={{-20, 250}, {20, 250}}, color={0, 0, 0}));
  connect(tiltDrive.support, robot.tiltSupport)
    annotation (Line(points={{-30, 240}, {-30, 235}, {20, 235}}, color={0, 0, 0}));
  connect(flex_phi, flexDrive.phi_ref)
    annotation (Line(points={{-130, 190}, {-42, 190}}, color={0, 0, 127}));
  connect(flexDrive.flange, robot.flexAxis)
    annotation (Line(points={{-20, 190}, {20, 190}}, color={0, 0, 0}));
  connect(flexDrive.support, robot.flexSupport)
    annotation (Line(points={{-30, 180}, {-30, 175}, {20, 175}}, color={0, 0, 0}));
  connect(roll_phi, rollDrive.phi_ref)
    annotation (Line(points={{-130, 160}, {-42, 160}}, color={0, 0, 127}));
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
</html>"));
end RigRun;
