within Rig;

model RigTest "Quick check of robot Rig: every axis moves inside its limits"
  extends UrdfSync.Robots.PartialBench;
  extends Modelica.Icons.Example;

  replaceable Rig robot
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 475}})));

  UrdfSync.Drives.RotationalSweep waistDrive(
    phi_start = robot.waist.phi_start,
    phi_min = robot.waist.phi_min,
    phi_max = robot.waist.phi_max,
    w_max = robot.waist.w_max)
    "Moves joint \"waist\" there and back"
    annotation (Placement(transformation(extent={{-40, 210}, {-20, 230}})));

  UrdfSync.Drives.TranslationalSweep liftDrive(
    s_start = robot.lift.s_start,
    s_min = robot.lift.s_min,
    s_max = robot.lift.s_max,
    v_max = robot.lift.v_max)
    "Moves joint \"lift\" there and back"
    annotation (Placement(transformation(extent={{-40, 330}, {-20, 350}})));

  UrdfSync.Drives.TranslationalSweep pushDrive(
    s_start = robot.push.s_start,
    s_min = robot.push.s_min,
    s_max = robot.push.s_max,
    v_max = robot.push.v_max)
    "Moves joint \"push\" there and back"
    annotation (Placement(transformation(extent={{-40, 270}, {-20, 290}})));

  UrdfSync.Drives.RotationalSweep tiltDrive(
    phi_start = robot.tilt.phi_start,
    phi_min = robot.tilt.phi_min,
    phi_max = robot.tilt.phi_max,
    w_max = robot.tilt.w_max)
    "Moves joint \"tilt\" there and back"
    annotation (Placement(transformation(extent={{-40, 240}, {-20, 260}})));

  UrdfSync.Drives.RotationalSweep flexDrive(
    phi_start = robot.flex.phi_start,
    phi_min = robot.flex.phi_min,
    phi_max = robot.flex.phi_max,
    w_max = robot.flex.w_max)
    "Moves joint \"flex\" there and back"
    annotation (Placement(transformation(extent={{-40, 180}, {-20, 200}})));

  UrdfSync.Drives.RotationalSweep rollDrive(
    phi_start = robot.roll.phi_start,
    phi_min = robot.roll.phi_min,
    phi_max = robot.roll.phi_max,
    w_max = robot.roll.w_max)
    "Moves joint \"roll\" there and back"
    annotation (Placement(transformation(extent={{-40, 150}, {-20, 170}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(waistDrive.flange, robot.waistAxis)
    annotation (Line(points={{-20, 220}, {20, 220}}, color={0, 0, 0}));
  connect(waistDrive.support, robot.waistSupport)
    annotation (Line(points={{-30, 210}, {-30, 205}, {20, 205}}, color={0, 0, 0}));
  connect(liftDrive.flange, robot.liftAxis)
    annotation (Line(points={{-20, 340}, {20, 340}}, color={0, 127, 0}));
  connect(liftDrive.support, robot.liftSupport)
    annotation (Line(points={{-30, 330}, {-30, 325}, {20, 325}}, color={0, 127, 0}));
  connect(pushDrive.flange, robot.pushAxis)
    annotation (Line(points={{-20, 280}, {20, 280}}, color={0, 127, 0}));
  connect(pushDrive.support, robot.pushSupport)
    annotation (Line(points={{-30, 270}, {-30, 265}, {20, 265}}, color={0, 127, 0}));
  connect(tiltDrive.flange, robot.tiltAxis)
    annotation (Line(points={{-20, 250}, {20, 250}}, color={0, 0, 0}));
  connect(tiltDrive.support, robot.tiltSupport)
    annotation (Line(points={{-30, 240}, {-30, 235}, {20, 235}}, color={0, 0, 0}));
  connect(flexDrive.flange, robot.flexAxis)
    annotation (Line(points={{-20, 190}, {20, 190}}, color={0, 0, 0}));
  connect(flexDrive.support, robot.flexSupport)
    annotation (Line(points={{-30, 180}, {-30, 175}, {20, 175}}, color={0, 0, 0}));
  connect(rollDrive.flange, robot.rollAxis)
    annotation (Line(points={{-20, 160}, {20, 160}}, color={0, 0, 0}));
  connect(rollDrive.support, robot.rollSupport)
    annotation (Line(points={{-30, 150}, {-30, 145}, {20, 145}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-120, -280}, {340, 495}})),
    Documentation(info="<html>
<p>
Simulates without inputs: every axis of robot Rig moves inside its limits and comes back. A warning in the log names a joint that passes one of its limits all the same, for example that of its effort. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end RigTest;
