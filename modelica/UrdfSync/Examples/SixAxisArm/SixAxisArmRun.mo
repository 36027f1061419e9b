within UrdfSync.Examples.SixAxisArm;

model SixAxisArmRun "Run robot SixAxisArm with positions from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialBench;

  replaceable SixAxisArm robot(
    fixedStart = false)
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 445}})));

  Modelica.Blocks.Interfaces.RealInput turret_phi(unit = "rad")
    "Where joint \"turret\" is to go"
    annotation (Placement(transformation(extent={{-140, 420}, {-120, 440}}), iconTransformation(extent={{-116, 307}, {-100, 323}})));

  Modelica.Blocks.Interfaces.RealOutput turret_tau(unit = "N.m") = robot.turretAxis.tau
    "What the drive of joint \"turret\" has to give"
    annotation (Placement(transformation(extent={{340, 420}, {360, 440}}), iconTransformation(extent={{100, 307}, {116, 323}})));

  Modelica.Mechanics.Rotational.Sources.Position turretDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"turret\", through a filter"
    annotation (Placement(transformation(extent={{-40, 420}, {-20, 440}})));

  Modelica.Blocks.Interfaces.RealInput shoulder_phi(unit = "rad")
    "Where joint \"shoulder\" is to go"
    annotation (Placement(transformation(extent={{-140, 210}, {-120, 230}}), iconTransformation(extent={{-116, 167}, {-100, 183}})));

  Modelica.Blocks.Interfaces.RealOutput shoulder_tau(unit = "N.m") = robot.shoulderAxis.tau
    "What the drive of joint \"shoulder\" has to give"
    annotation (Placement(transformation(extent={{340, 210}, {360, 230}}), iconTransformation(extent={{100, 167}, {116, 183}})));

  Modelica.Mechanics.Rotational.Sources.Position shoulderDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"shoulder\", through a filter"
    annotation (Placement(transformation(extent={{-40, 210}, {-20, 230}})));

  Modelica.Blocks.Interfaces.RealInput elbow_phi(unit = "rad")
    "Where joint \"elbow\" is to go"
    annotation (Placement(transformation(extent={{-140, 330}, {-120, 350}}), iconTransformation(extent={{-116, 247}, {-100, 263}})));

  Modelica.Blocks.Interfaces.RealOutput elbow_tau(unit = "N.m") = robot.elbowAxis.tau
    "What the drive of joint \"elbow\" has to give"
    annotation (Placement(transformation(extent={{340, 330}, {360, 350}}), iconTransformation(extent={{100, 247}, {116, 263}})));

  Modelica.Mechanics.Rotational.Sources.Position elbowDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"elbow\", through a filter"
    annotation (Placement(transformation(extent={{-40, 330}, {-20, 350}})));

  Modelica.Blocks.Interfaces.RealInput forearm_roll_phi(unit = "rad")
    "Where joint \"forearm_roll\" is to go"
    annotation (Placement(transformation(extent={{-140, 270}, {-120, 290}}), iconTransformation(extent={{-116, 207}, {-100, 223}})));

  Modelica.Blocks.Interfaces.RealOutput forearm_roll_tau(unit = "N.m") = robot.forearm_rollAxis.tau
    "What the drive of joint \"forearm_roll\" has to give"
    annotation (Placement(transformation(extent={{340, 270}, {360, 290}}), iconTransformation(extent={{100, 207}, {116, 223}})));

  Modelica.Mechanics.Rotational.Sources.Position forearm_rollDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"forearm_roll\", through a filter"
    annotation (Placement(transformation(extent={{-40, 270}, {-20, 290}})));

  Modelica.Blocks.Interfaces.RealInput wrist_pitch_phi(unit = "rad")
    "Where joint \"wrist_pitch\" is to go"
    annotation (Placement(transformation(extent={{-140, 150}, {-120, 170}}), iconTransformation(extent={{-116, 127}, {-100, 143}})));

  Modelica.Blocks.Interfaces.RealOutput wrist_pitch_tau(unit = "N.m") = robot.wrist_pitchAxis.tau
    "What the drive of joint \"wrist_pitch\" has to give"
    annotation (Placement(transformation(extent={{340, 150}, {360, 170}}), iconTransformation(extent={{100, 127}, {116, 143}})));

  Modelica.Mechanics.Rotational.Sources.Position wrist_pitchDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"wrist_pitch\", through a filter"
    annotation (Placement(transformation(extent={{-40, 150}, {-20, 170}})));

  Modelica.Blocks.Interfaces.RealInput flange_roll_phi(unit = "rad")
    "Where joint \"flange_roll\" is to go"
    annotation (Placement(transformation(extent={{-140, 120}, {-120, 140}}), iconTransformation(extent={{-116, 107}, {-100, 123}})));

  Modelica.Blocks.Interfaces.RealOutput flange_roll_tau(unit = "N.m") = robot.flange_rollAxis.tau
    "What the drive of joint \"flange_roll\" has to give"
    annotation (Placement(transformation(extent={{340, 120}, {360, 140}}), iconTransformation(extent={{100, 107}, {116, 123}})));

  Modelica.Mechanics.Rotational.Sources.Position flange_rollDrive(
    useSupport = true,
    exact = false,
    w(fixed = true))
    "Moves joint \"flange_roll\", through a filter"
    annotation (Placement(transformation(extent={{-40, 120}, {-20, 140}})));

  Modelica.Blocks.Interfaces.RealInput gripper_stroke_s(unit = "m")
    "Where joint \"gripper_stroke\" is to go"
    annotation (Placement(transformation(extent={{-140, 180}, {-120, 200}}), iconTransformation(extent={{-116, 147}, {-100, 163}})));

  Modelica.Blocks.Interfaces.RealOutput gripper_stroke_f(unit = "N") = robot.gripper_strokeAxis.f
    "What the drive of joint \"gripper_stroke\" has to give"
    annotation (Placement(transformation(extent={{340, 180}, {360, 200}}), iconTransformation(extent={{100, 147}, {116, 163}})));

  Modelica.Mechanics.Translational.Sources.Position gripper_strokeDrive(
    useSupport = true,
    exact = false,
    v(fixed = true))
    "Moves joint \"gripper_stroke\", through a filter"
    annotation (Placement(transformation(extent={{-40, 180}, {-20, 200}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));
  connect(turret_phi, turretDrive.phi_ref)
    annotation (Line(points={{-130, 430}, {-42, 430}}, color={0, 0, 127}));
  connect(turretDrive.flange, robot.turretAxis)
    annotation (Line(points={{-20, 430}, {20, 430}}, color={0, 0, 0}));
  connect(turretDrive.support, robot.turretSupport)
    annotation (Line(points={{-30, 420}, {-30, 415}, {20, 415}}, color={0, 0, 0}));
  connect(shoulder_phi, shoulderDrive.phi_ref)
    annotation (Line(points={{-130, 220}, {-42, 220}}, color={0, 0, 127}));
  connect(shoulderDrive.flange, robot.shoulderAxis)
    annotation (Line(points={{-20, 220}, {20, 220}}, color={0, 0, 0}));
  connect(shoulderDrive.support, robot.shoulderSupport)
    annotation (Line(points={{-30, 210}, {-30, 205}, {20, 205}}, color={0, 0, 0}));
  connect(elbow_phi, elbowDrive.phi_ref)
    annotation (Line(points={{-130, 340}, {-42, 340}}, color={0, 0, 127}));
  connect(elbowDrive.flange, robot.elbowAxis)
    annotation (Line(points={{-20, 340}, {20, 340}}, color={0, 0, 0}));
  connect(elbowDrive.support, robot.elbowSupport)
    annotation (Line(points={{-30, 330}, {-30, 325}, {20, 325}}, color={0, 0, 0}));
  connect(forearm_roll_phi, forearm_rollDrive.phi_ref)
    annotation (Line(points={{-130, 280}, {-42, 280}}, color={0, 0, 127}));
  connect(forearm_rollDrive.flange, robot.forearm_rollAxis)
    annotation (Line(points={{-20, 280}, {20, 280}}, color={0, 0, 0}));
  connect(forearm_rollDrive.support, robot.forearm_rollSupport)
    annotation (Line(points={{-30, 270}, {-30, 265}, {20, 265}}, color={0, 0, 0}));
  connect(wrist_pitch_phi, wrist_pitchDrive.phi_ref)
    annotation (Line(points={{-130, 160}, {-42, 160}}, color={0, 0, 127}));
  connect(wrist_pitchDrive.flange, robot.wrist_pitchAxis)
    annotation (Line(points={{-20, 160}, {20, 160}}, color={0, 0, 0}));
  connect(wrist_pitchDrive.support, robot.wrist_pitchSupport)
    annotation (Line(points={{-30, 150}, {-30, 145}, {20, 145}}, color={0, 0, 0}));
  connect(flange_roll_phi, flange_rollDrive.phi_ref)
    annotation (Line(points={{-130, 130}, {-42, 130}}, color={0, 0, 127}));
  connect(flange_rollDrive.flange, robot.flange_rollAxis)
    annotation (Line(points={{-20, 130}, {20, 130}}, color={0, 0, 0}));
  connect(flange_rollDrive.support, robot.flange_rollSupport)
    annotation (Line(points={{-30, 120}, {-30, 115}, {20, 115}}, color={0, 0, 0}));
  connect(gripper_stroke_s, gripper_strokeDrive.s_ref)
    annotation (Line(points={{-130, 190}, {-42, 190}}, color={0, 0, 127}));
  connect(gripper_strokeDrive.flange, robot.gripper_strokeAxis)
    annotation (Line(points={{-20, 190}, {20, 190}}, color={0, 127, 0}));
  connect(gripper_strokeDrive.support, robot.gripper_strokeSupport)
    annotation (Line(points={{-30, 180}, {-30, 175}, {20, 175}}, color={0, 127, 0}));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 330}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 330}}, lineColor={110, 110, 110}, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-94, 306}, {94, 324}}, textColor={64, 64, 64}, textString="turret"),
      Text(extent={{-94, 166}, {94, 184}}, textColor={64, 64, 64}, textString="shoulder"),
      Text(extent={{-94, 246}, {94, 264}}, textColor={64, 64, 64}, textString="elbow"),
      Text(extent={{-94, 206}, {94, 224}}, textColor={64, 64, 64}, textString="forearm_roll"),
      Text(extent={{-94, 126}, {94, 144}}, textColor={64, 64, 64}, textString="wrist_pitch"),
      Text(extent={{-94, 106}, {94, 124}}, textColor={64, 64, 64}, textString="flange_roll"),
      Text(extent={{-94, 146}, {94, 164}}, textColor={64, 64, 64}, textString="gripper_stroke")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 465}})),
    Documentation(info="<html>
<p>
Robot SixAxisArm in its world, with one input per axis for its position and one output for what its drive has to give. The inputs are filtered, so that they need no derivatives. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-ca32", base = "f361b3c7d8ae31b4"));
end SixAxisArmRun;
