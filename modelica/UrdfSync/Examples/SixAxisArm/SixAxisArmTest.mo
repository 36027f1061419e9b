within UrdfSync.Examples.SixAxisArm;

model SixAxisArmTest "Quick check of robot SixAxisArm: every axis moves inside its limits"
  extends UrdfSync.Robots.PartialBench;
  extends Modelica.Icons.Example;

  replaceable SixAxisArm robot
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 445}})));

  UrdfSync.Drives.RotationalSweep turretDrive(
    phi_start = robot.turret.phi_start,
    phi_min = robot.turret.phi_min,
    phi_max = robot.turret.phi_max,
    w_max = robot.turret.w_max)
    "Moves joint \"turret\" there and back"
    annotation (Placement(transformation(extent={{-40, 420}, {-20, 440}})));

  UrdfSync.Drives.RotationalSweep shoulderDrive(
    phi_start = robot.shoulder.phi_start,
    phi_min = robot.shoulder.phi_min,
    phi_max = robot.shoulder.phi_max,
    w_max = robot.shoulder.w_max)
    "Moves joint \"shoulder\" there and back"
    annotation (Placement(transformation(extent={{-40, 210}, {-20, 230}})));

  UrdfSync.Drives.RotationalSweep elbowDrive(
    phi_start = robot.elbow.phi_start,
    phi_min = robot.elbow.phi_min,
    phi_max = robot.elbow.phi_max,
    w_max = robot.elbow.w_max)
    "Moves joint \"elbow\" there and back"
    annotation (Placement(transformation(extent={{-40, 330}, {-20, 350}})));

  UrdfSync.Drives.RotationalSweep forearm_rollDrive(
    phi_start = robot.forearm_roll.phi_start,
    phi_min = robot.forearm_roll.phi_min,
    phi_max = robot.forearm_roll.phi_max,
    w_max = robot.forearm_roll.w_max)
    "Moves joint \"forearm_roll\" there and back"
    annotation (Placement(transformation(extent={{-40, 270}, {-20, 290}})));

  UrdfSync.Drives.RotationalSweep wrist_pitchDrive(
    phi_start = robot.wrist_pitch.phi_start,
    phi_min = robot.wrist_pitch.phi_min,
    phi_max = robot.wrist_pitch.phi_max,
    w_max = robot.wrist_pitch.w_max)
    "Moves joint \"wrist_pitch\" there and back"
    annotation (Placement(transformation(extent={{-40, 150}, {-20, 170}})));

  UrdfSync.Drives.RotationalSweep flange_rollDrive(
    phi_start = robot.flange_roll.phi_start,
    phi_min = robot.flange_roll.phi_min,
    phi_max = robot.flange_roll.phi_max,
    w_max = robot.flange_roll.w_max)
    "Moves joint \"flange_roll\" there and back"
    annotation (Placement(transformation(extent={{-40, 120}, {-20, 140}})));

  UrdfSync.Drives.TranslationalSweep gripper_strokeDrive(
    s_start = robot.gripper_stroke.s_start,
    s_min = robot.gripper_stroke.s_min,
    s_max = robot.gripper_stroke.s_max,
    v_max = robot.gripper_stroke.v_max)
    "Moves joint \"gripper_stroke\" there and back"
    annotation (Placement(transformation(extent={{-40, 180}, {-20, 200}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(turretDrive.flange, robot.turretAxis)
    annotation (Line(points={{-20, 430}, {20, 430}}, color={0, 0, 0}));
  connect(turretDrive.support, robot.turretSupport)
    annotation (Line(points={{-30, 420}, {-30, 415}, {20, 415}}, color={0, 0, 0}));
  connect(shoulderDrive.flange, robot.shoulderAxis)
    annotation (Line(points={{-20, 220}, {20, 220}}, color={0, 0, 0}));
  connect(shoulderDrive.support, robot.shoulderSupport)
    annotation (Line(points={{-30, 210}, {-30, 205}, {20, 205}}, color={0, 0, 0}));
  connect(elbowDrive.flange, robot.elbowAxis)
    annotation (Line(points={{-20, 340}, {20, 340}}, color={0, 0, 0}));
  connect(elbowDrive.support, robot.elbowSupport)
    annotation (Line(points={{-30, 330}, {-30, 325}, {20, 325}}, color={0, 0, 0}));
  connect(forearm_rollDrive.flange, robot.forearm_rollAxis)
    annotation (Line(points={{-20, 280}, {20, 280}}, color={0, 0, 0}));
  connect(forearm_rollDrive.support, robot.forearm_rollSupport)
    annotation (Line(points={{-30, 270}, {-30, 265}, {20, 265}}, color={0, 0, 0}));
  connect(wrist_pitchDrive.flange, robot.wrist_pitchAxis)
    annotation (Line(points={{-20, 160}, {20, 160}}, color={0, 0, 0}));
  connect(wrist_pitchDrive.support, robot.wrist_pitchSupport)
    annotation (Line(points={{-30, 150}, {-30, 145}, {20, 145}}, color={0, 0, 0}));
  connect(flange_rollDrive.flange, robot.flange_rollAxis)
    annotation (Line(points={{-20, 130}, {20, 130}}, color={0, 0, 0}));
  connect(flange_rollDrive.support, robot.flange_rollSupport)
    annotation (Line(points={{-30, 120}, {-30, 115}, {20, 115}}, color={0, 0, 0}));
  connect(gripper_strokeDrive.flange, robot.gripper_strokeAxis)
    annotation (Line(points={{-20, 190}, {20, 190}}, color={0, 127, 0}));
  connect(gripper_strokeDrive.support, robot.gripper_strokeSupport)
    annotation (Line(points={{-30, 180}, {-30, 175}, {20, 175}}, color={0, 127, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-120, -280}, {340, 465}})),
    Documentation(info="<html>
<p>
Simulates without inputs: every axis of robot SixAxisArm moves inside its limits and comes back. A warning in the log names a joint that passes one of its limits all the same, for example that of its effort. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-5e01", base = "cbb03e4503f5c55a"));
end SixAxisArmTest;
