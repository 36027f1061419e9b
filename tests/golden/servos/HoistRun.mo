within Hoist;

model HoistRun "Run robot Hoist with commands from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialBench;

  replaceable Hoist robot(
    fixedStart = false,
    fan(fixedStart = true),
    swing(fixedStart = true),
    trolley(fixedStart = true),
    drum(fixedStart = true),
    rope(fixedStart = true))
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 295}})));

  Modelica.Blocks.Interfaces.RealInput beacon_phi(unit = "rad")
    "Where joint \"beacon\" is to go"
    annotation (Placement(transformation(extent={{-140, 240}, {-120, 260}}), iconTransformation(extent={{-116, 187}, {-100, 203}})));

  Modelica.Blocks.Interfaces.RealOutput beacon_tau(unit = "N.m") = robot.beaconAxis.tau
    "What the drive of joint \"beacon\" has to give"
    annotation (Placement(transformation(extent={{340, 240}, {360, 260}}), iconTransformation(extent={{100, 187}, {116, 203}})));

  Modelica.Mechanics.Rotational.Sources.Position beaconDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"beacon\", through a filter"
    annotation (Placement(transformation(extent={{-40, 240}, {-20, 260}})));

  Modelica.Blocks.Interfaces.RealInput fan_tau(unit = "N.m")
    "What the drive of joint \"fan\" gives"
    annotation (Placement(transformation(extent={{-140, 150}, {-120, 170}}), iconTransformation(extent={{-116, 127}, {-100, 143}})));

  Modelica.Blocks.Interfaces.RealOutput fan_phi(unit = "rad") = robot.fanAxis.phi - robot.fanSupport.phi
    "Where joint \"fan\" is"
    annotation (Placement(transformation(extent={{340, 160}, {350, 170}}), iconTransformation(extent={{100, 136}, {108, 144}})));

  Modelica.Blocks.Interfaces.RealOutput fan_w(unit = "rad/s") = der(fan_phi)
    "How fast joint \"fan\" is"
    annotation (Placement(transformation(extent={{340, 148}, {350, 158}}), iconTransformation(extent={{100, 126}, {108, 134}})));

  Modelica.Mechanics.Rotational.Sources.Torque fanDrive(useSupport = true)
    "Pushes joint \"fan\""
    annotation (Placement(transformation(extent={{-40, 150}, {-20, 170}})));

  Modelica.Blocks.Interfaces.RealInput swing_phi(unit = "rad")
    "Where joint \"swing\" is to go"
    annotation (Placement(transformation(extent={{-140, 180}, {-120, 200}}), iconTransformation(extent={{-116, 147}, {-100, 163}})));

  Modelica.Blocks.Interfaces.RealOutput swing_tau(unit = "N.m") = robot.swingAxis.tau
    "What the drive of joint \"swing\" has to give"
    annotation (Placement(transformation(extent={{340, 180}, {360, 200}}), iconTransformation(extent={{100, 147}, {116, 163}})));

  UrdfSync.Drives.RotationalPositionServo swingDrive(
    tau_max = robot.swing.parameters.limits.effort,
    w_max = robot.swing.parameters.limits.velocity,
    parameters = robot.swing.parameters.servo)
    "Pushes joint \"swing\" by its law"
    annotation (Placement(transformation(extent={{-40, 180}, {-20, 200}})));

  Modelica.Blocks.Interfaces.RealInput trolley_v(unit = "m/s")
    "How fast joint \"trolley\" is to go"
    annotation (Placement(transformation(extent={{-140, 270}, {-120, 290}}), iconTransformation(extent={{-116, 207}, {-100, 223}})));

  Modelica.Blocks.Interfaces.RealOutput trolley_f(unit = "N") = robot.trolleyAxis.f
    "What the drive of joint \"trolley\" has to give"
    annotation (Placement(transformation(extent={{340, 270}, {360, 290}}), iconTransformation(extent={{100, 207}, {116, 223}})));

  UrdfSync.Drives.TranslationalIntegralServo trolleyDrive(
    s_start = robot.trolley.s_start,
    parameters = robot.trolley.parameters.servo)
    "Pushes joint \"trolley\" by its law"
    annotation (Placement(transformation(extent={{-40, 270}, {-20, 290}})));

  Modelica.Blocks.Interfaces.RealInput drum_w(unit = "rad/s")
    "How fast joint \"drum\" is to go"
    annotation (Placement(transformation(extent={{-140, 120}, {-120, 140}}), iconTransformation(extent={{-116, 107}, {-100, 123}})));

  Modelica.Blocks.Interfaces.RealOutput drum_tau(unit = "N.m") = robot.drumAxis.tau
    "What the drive of joint \"drum\" has to give"
    annotation (Placement(transformation(extent={{340, 120}, {360, 140}}), iconTransformation(extent={{100, 107}, {116, 123}})));

  UrdfSync.Drives.RotationalVelocityServo drumDrive(
    parameters = robot.drum.parameters.servo)
    "Pushes joint \"drum\" by its law"
    annotation (Placement(transformation(extent={{-40, 120}, {-20, 140}})));

  Modelica.Blocks.Interfaces.RealInput rope_f(unit = "N")
    "What the drive of joint \"rope\" gives"
    annotation (Placement(transformation(extent={{-140, 210}, {-120, 230}}), iconTransformation(extent={{-116, 167}, {-100, 183}})));

  Modelica.Blocks.Interfaces.RealOutput rope_s(unit = "m") = robot.ropeAxis.s - robot.ropeSupport.s
    "Where joint \"rope\" is"
    annotation (Placement(transformation(extent={{340, 220}, {350, 230}}), iconTransformation(extent={{100, 176}, {108, 184}})));

  Modelica.Blocks.Interfaces.RealOutput rope_v(unit = "m/s") = der(rope_s)
    "How fast joint \"rope\" is"
    annotation (Placement(transformation(extent={{340, 208}, {350, 218}}), iconTransformation(extent={{100, 166}, {108, 174}})));

  Modelica.Mechanics.Translational.Sources.Force ropeDrive(useSupport = true)
    "Pushes joint \"rope\""
    annotation (Placement(transformation(extent={{-40, 210}, {-20, 230}})));

  Modelica.Blocks.Interfaces.RealOutput level_a[3](each unit = "m/s2") = robot.level.a
    "Acceleration minus gravity that sensor \"level\" shows"
    annotation (Placement(transformation(extent={{340, 70}, {360, 90}}), iconTransformation(extent={{100, 86}, {108, 94}})));

  Modelica.Blocks.Interfaces.RealOutput sway_w[3](each unit = "rad/s") = robot.sway.w
    "Angular velocity that sensor \"sway\" shows"
    annotation (Placement(transformation(extent={{340, 50}, {360, 70}}), iconTransformation(extent={{100, 76}, {108, 84}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(beacon_phi, beaconDrive.phi_ref)
    annotation (Line(points={{-130, 250}, {-42, 250}}, color={0, 0, 127}));
  connect(beaconDrive.flange, robot.beaconAxis)
    annotation (Line(points={{-20, 250}, {20, 250}}, color={0, 0, 0}));
  connect(beaconDrive.support, robot.beaconSupport)
    annotation (Line(points={{-30, 240}, {-30, 235}, {20, 235}}, color={0, 0, 0}));
  fanDrive.tau = UrdfSync.Functions.limited(
    fan_tau,
    robot.fan.parameters.servo.minEffort,
    robot.fan.parameters.servo.maxEffort);
  connect(fanDrive.flange, robot.fanAxis)
    annotation (Line(points={{-20, 160}, {20, 160}}, color={0, 0, 0}));
  connect(fanDrive.support, robot.fanSupport)
    annotation (Line(points={{-30, 150}, {-30, 145}, {20, 145}}, color={0, 0, 0}));
  connect(swing_phi, swingDrive.phi_ref)
    annotation (Line(points={{-130, 190}, {-42, 190}}, color={0, 0, 127}));
  connect(swingDrive.flange, robot.swingAxis)
    annotation (Line(points={{-20, 190}, {20, 190}}, color={0, 0, 0}));
  connect(swingDrive.support, robot.swingSupport)
    annotation (Line(points={{-30, 180}, {-30, 175}, {20, 175}}, color={0, 0, 0}));
  connect(trolley_v, trolleyDrive.v_ref)
    annotation (Line(points={{-130, 280}, {-42, 280}}, color={0, 0, 127}));
  connect(trolleyDrive.flange, robot.trolleyAxis)
    annotation (Line(points={{-20, 280}, {20, 280}}, color={0, 127, 0}));
  connect(trolleyDrive.support, robot.trolleySupport)
    annotation (Line(points={{-30, 270}, {-30, 265}, {20, 265}}, color={0, 127, 0}));
  connect(drum_w, drumDrive.w_ref)
    annotation (Line(points={{-130, 130}, {-42, 130}}, color={0, 0, 127}));
  connect(drumDrive.flange, robot.drumAxis)
    annotation (Line(points={{-20, 130}, {20, 130}}, color={0, 0, 0}));
  connect(drumDrive.support, robot.drumSupport)
    annotation (Line(points={{-30, 120}, {-30, 115}, {20, 115}}, color={0, 0, 0}));
  ropeDrive.f = UrdfSync.Functions.limitedEffort(
    UrdfSync.Functions.limited(
      rope_f,
      robot.rope.parameters.servo.minEffort,
      robot.rope.parameters.servo.maxEffort),
    rope_v,
    robot.rope.parameters.limits.effort,
    robot.rope.parameters.limits.velocity);
  connect(ropeDrive.flange, robot.ropeAxis)
    annotation (Line(points={{-20, 220}, {20, 220}}, color={0, 127, 0}));
  connect(ropeDrive.support, robot.ropeSupport)
    annotation (Line(points={{-30, 210}, {-30, 205}, {20, 205}}, color={0, 127, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 230}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 230}}, lineColor={110, 110, 110}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-94, 186}, {94, 204}}, textColor={64, 64, 64}, textString="beacon"),
      Text(extent={{-94, 126}, {94, 144}}, textColor={64, 64, 64}, textString="fan"),
      Text(extent={{-94, 146}, {94, 164}}, textColor={64, 64, 64}, textString="swing"),
      Text(extent={{-94, 206}, {94, 224}}, textColor={64, 64, 64}, textString="trolley"),
      Text(extent={{-94, 106}, {94, 124}}, textColor={64, 64, 64}, textString="drum"),
      Text(extent={{-94, 166}, {94, 184}}, textColor={64, 64, 64}, textString="rope")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 315}})),
    Documentation(info="<html>
<p>
Robot Hoist in its world, with one input per axis: its position, velocity or effort, as the source or the configuration commands it. Positions and velocities are filtered, so that they need no derivatives, and have an output for what the drive has to give; where the input is that, the outputs are position and velocity. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
<p>
A joint whose drive has a law is not moved exactly: the drive pushes it as <code>servo</code> in the joint's record says.
</p>
</html>"));
end HoistRun;
