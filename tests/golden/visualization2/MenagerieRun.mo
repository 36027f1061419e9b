within Zoo.Menagerie;

model MenagerieRun "Run robot Menagerie with positions from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialBench;

  inner Visualization2.VisualizationSetup visualizationSetup
    "Animation"
    annotation (Placement(transformation(extent={{-100, -100}, {-80, -80}})));

  replaceable Menagerie robot(
    fixedStart = false)
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 505}})));

  Modelica.Blocks.Interfaces.RealInput positions[3](unit = {"m", "rad", "rad"})
    "Where the joints are to go, in the order of the chain: the documentation names them"
    annotation (Placement(transformation(extent={{-140, 120}, {-120, 140}}), iconTransformation(extent={{-140, -20}, {-100, 20}})));

  Modelica.Blocks.Interfaces.RealOutput lift_f(unit = "N") = robot.liftAxis.f
    "What the drive of joint \"lift\" has to give"
    annotation (Placement(transformation(extent={{340, 120}, {360, 140}}), iconTransformation(extent={{100, 107}, {116, 123}})));

  Modelica.Mechanics.Translational.Sources.Position liftDrive(
    useSupport = true,
    exact = false,
    v(fixed = true))
    "Moves joint \"lift\", through a filter"
    annotation (Placement(transformation(extent={{-40, 120}, {-20, 140}})));

  Modelica.Blocks.Interfaces.RealOutput rotational_tau(unit = "N.m") = robot.rotationalAxis_2.tau
    "What the drive of joint \"rotational\" has to give"
    annotation (Placement(transformation(extent={{340, 210}, {360, 230}}), iconTransformation(extent={{100, 167}, {116, 183}})));

  Modelica.Mechanics.Rotational.Sources.Position rotationalDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"rotational\", through a filter"
    annotation (Placement(transformation(extent={{-40, 210}, {-20, 230}})));

  Modelica.Blocks.Interfaces.RealOutput shoulder_tau(unit = "N.m") = robot.shoulderAxis.tau
    "What the drive of joint \"shoulder\" has to give"
    annotation (Placement(transformation(extent={{340, 150}, {360, 170}}), iconTransformation(extent={{100, 127}, {116, 143}})));

  Modelica.Mechanics.Rotational.Sources.Position shoulderDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"shoulder\", through a filter"
    annotation (Placement(transformation(extent={{-40, 150}, {-20, 170}})));

  Modelica.Blocks.Interfaces.RealOutput imu_a[3](each unit = "m/s2") = robot.imu.a
    "Acceleration minus gravity that sensor \"imu\" shows"
    annotation (Placement(transformation(extent={{340, 70}, {360, 90}}), iconTransformation(extent={{100, 86}, {108, 94}})));

  Modelica.Blocks.Interfaces.RealOutput imu_w[3](each unit = "rad/s") = robot.imu.w
    "Angular velocity that sensor \"imu\" shows"
    annotation (Placement(transformation(extent={{340, 50}, {360, 70}}), iconTransformation(extent={{100, 76}, {108, 84}})));

  Modelica.Blocks.Interfaces.RealOutput lift_sensor_8cfdf3_f[3](each unit = "N") = robot.lift_sensor_8cfdf3.f
    "Force that sensor \"lift\" shows"
    annotation (Placement(transformation(extent={{340, 30}, {360, 50}}), iconTransformation(extent={{100, 66}, {108, 74}})));

  Modelica.Blocks.Interfaces.RealOutput lift_sensor_8cfdf3_t[3](each unit = "N.m") = robot.lift_sensor_8cfdf3.t
    "Torque that sensor \"lift\" shows"
    annotation (Placement(transformation(extent={{340, 10}, {360, 30}}), iconTransformation(extent={{100, 56}, {108, 64}})));

  Modelica.Blocks.Interfaces.RealOutput strain_f[3](each unit = "N") = robot.strain.f
    "Force that sensor \"strain\" shows"
    annotation (Placement(transformation(extent={{340, -10}, {360, 10}}), iconTransformation(extent={{100, 46}, {108, 54}})));

  Modelica.Blocks.Interfaces.RealOutput strain_t[3](each unit = "N.m") = robot.strain.t
    "Torque that sensor \"strain\" shows"
    annotation (Placement(transformation(extent={{340, -30}, {360, -10}}), iconTransformation(extent={{100, 36}, {108, 44}})));

  Modelica.Blocks.Interfaces.RealOutput torque_f[3](each unit = "N") = robot.torque.f
    "Force that sensor \"torque\" shows"
    annotation (Placement(transformation(extent={{340, -50}, {360, -30}}), iconTransformation(extent={{100, 26}, {108, 34}})));

  Modelica.Blocks.Interfaces.RealOutput torque_t[3](each unit = "N.m") = robot.torque.t
    "Torque that sensor \"torque\" shows"
    annotation (Placement(transformation(extent={{340, -70}, {360, -50}}), iconTransformation(extent={{100, 16}, {108, 24}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(positions[1], liftDrive.s_ref)
    annotation (Line(points={{-130, 130}, {-80, 130}, {-80, 130}, {-42, 130}}, color={0, 0, 127}));
  connect(liftDrive.flange, robot.liftAxis)
    annotation (Line(points={{-20, 130}, {20, 130}}, color={0, 127, 0}));
  connect(liftDrive.support, robot.liftSupport)
    annotation (Line(points={{-30, 120}, {-30, 115}, {20, 115}}, color={0, 127, 0}));
  connect(positions[2], rotationalDrive.phi_ref)
    annotation (Line(points={{-130, 130}, {-80, 130}, {-80, 220}, {-42, 220}}, color={0, 0, 127}));
  connect(rotationalDrive.flange, robot.rotationalAxis_2)
    annotation (Line(points={{-20, 220}, {20, 220}}, color={0, 0, 0}));
  connect(rotationalDrive.support, robot.rotationalSupport_2)
    annotation (Line(points={{-30, 210}, {-30, 205}, {20, 205}}, color={0, 0, 0}));
  connect(positions[3], shoulderDrive.phi_ref)
    annotation (Line(points={{-130, 130}, {-80, 130}, {-80, 160}, {-42, 160}}, color={0, 0, 127}));
  connect(shoulderDrive.flange, robot.shoulderAxis)
    annotation (Line(points={{-20, 160}, {20, 160}}, color={0, 0, 0}));
  connect(shoulderDrive.support, robot.shoulderSupport)
    annotation (Line(points={{-30, 150}, {-30, 145}, {20, 145}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 370}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 370}}, lineColor={110, 110, 110}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-94, 106}, {94, 124}}, textColor={64, 64, 64}, textString="lift"),
      Text(extent={{-94, 166}, {94, 184}}, textColor={64, 64, 64}, textString="rotational"),
      Text(extent={{-94, 126}, {94, 144}}, textColor={64, 64, 64}, textString="shoulder")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 525}})),
    Documentation(info="<html>
<p>
Robot Menagerie in its world, with one input per axis for its position and one output for what its drive has to give. The inputs are filtered, so that they need no derivatives. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
<p>
The elements of <code>positions</code> belong to these joints:
</p>
<ol>
<li><code>lift</code> (m)</li>
<li><code>rotational</code> (rad)</li>
<li><code>shoulder</code> (rad)</li>
</ol>
</html>"));
end MenagerieRun;
