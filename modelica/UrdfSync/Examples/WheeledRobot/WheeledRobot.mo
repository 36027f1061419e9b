within UrdfSync.Examples.WheeledRobot;

model WheeledRobot "Robot WheeledRobot"
  extends UrdfSync.Robots.PartialMobileRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b caster_wheelFrame
    "Frame of link \"caster_wheel\""
    annotation (Placement(transformation(extent={{40, -10}, {60, 10}}), iconTransformation(extent={{92, 252}, {108, 268}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b wheel_leftFrame
    "Frame of link \"wheel_left\""
    annotation (Placement(transformation(extent={{-8, -88}, {12, -68}}), iconTransformation(extent={{92, 232}, {108, 248}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b wheel_rightFrame
    "Frame of link \"wheel_right\""
    annotation (Placement(transformation(extent={{-8, -166}, {12, -146}}), iconTransformation(extent={{92, 212}, {108, 228}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b camera_optical_frameFrame
    "Frame of link \"camera_optical_frame\""
    annotation (Placement(transformation(extent={{184, -244}, {204, -224}}), iconTransformation(extent={{92, 192}, {108, 208}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b lidarFrame
    "Frame of link \"lidar\""
    annotation (Placement(transformation(extent={{40, -322}, {60, -302}}), iconTransformation(extent={{92, 172}, {108, 188}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b lidar_sensorFrame
    "Frame of sensor \"lidar\""
    annotation (Placement(transformation(extent={{48, -372}, {60, -360}}), iconTransformation(extent={{92, 152}, {108, 168}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a caster_swivelAxis
    "Axis of joint \"caster_swivel\""
    annotation (Placement(transformation(extent={{-52, 14}, {-40, 26}}), iconTransformation(extent={{-104, 256}, {-96, 264}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b caster_swivelSupport
    "Housing of the drive of joint \"caster_swivel\""
    annotation (Placement(transformation(extent={{-66, 14}, {-54, 26}}), iconTransformation(extent={{-104, 246}, {-96, 254}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a caster_rollAxis
    "Axis of joint \"caster_roll\""
    annotation (Placement(transformation(extent={{-4, 14}, {8, 26}}), iconTransformation(extent={{-104, 236}, {-96, 244}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b caster_rollSupport
    "Housing of the drive of joint \"caster_roll\""
    annotation (Placement(transformation(extent={{-18, 14}, {-6, 26}}), iconTransformation(extent={{-104, 226}, {-96, 234}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a drive_leftAxis
    "Axis of joint \"drive_left\""
    annotation (Placement(transformation(extent={{-52, -64}, {-40, -52}}), iconTransformation(extent={{-104, 216}, {-96, 224}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b drive_leftSupport
    "Housing of the drive of joint \"drive_left\""
    annotation (Placement(transformation(extent={{-66, -64}, {-54, -52}}), iconTransformation(extent={{-104, 206}, {-96, 214}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a drive_rightAxis
    "Axis of joint \"drive_right\""
    annotation (Placement(transformation(extent={{-52, -142}, {-40, -130}}), iconTransformation(extent={{-104, 196}, {-96, 204}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b drive_rightSupport
    "Housing of the drive of joint \"drive_right\""
    annotation (Placement(transformation(extent={{-66, -142}, {-54, -130}}), iconTransformation(extent={{-104, 186}, {-96, 194}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a liftAxis
    "Axis of joint \"lift\""
    annotation (Placement(transformation(extent={{-4, -220}, {8, -208}}), iconTransformation(extent={{-104, 176}, {-96, 184}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b liftSupport
    "Housing of the drive of joint \"lift\""
    annotation (Placement(transformation(extent={{-18, -220}, {-6, -208}}), iconTransformation(extent={{-104, 166}, {-96, 174}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a head_panAxis
    "Axis of joint \"head_pan\""
    annotation (Placement(transformation(extent={{44, -220}, {56, -208}}), iconTransformation(extent={{-104, 156}, {-96, 164}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b head_panSupport
    "Housing of the drive of joint \"head_pan\""
    annotation (Placement(transformation(extent={{30, -220}, {42, -208}}), iconTransformation(extent={{-104, 146}, {-96, 154}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a head_tiltAxis
    "Axis of joint \"head_tilt\""
    annotation (Placement(transformation(extent={{92, -220}, {104, -208}}), iconTransformation(extent={{-104, 136}, {-96, 144}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b head_tiltSupport
    "Housing of the drive of joint \"head_tilt\""
    annotation (Placement(transformation(extent={{78, -220}, {90, -208}}), iconTransformation(extent={{-104, 126}, {-96, 134}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a lidar_spinAxis
    "Axis of joint \"lidar_spin\""
    annotation (Placement(transformation(extent={{-4, -298}, {8, -286}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b lidar_spinSupport
    "Housing of the drive of joint \"lidar_spin\""
    annotation (Placement(transformation(extent={{-18, -298}, {-6, -286}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

  final parameter Modelica.Units.SI.Mass m =
    base_link.m +
    caster_fork.m +
    caster_wheel.m +
    wheel_left.m +
    wheel_right.m +
    column_guide.m +
    column.m +
    neck.m +
    head.m +
    camera_optical_frame.m +
    lidar_mast.m +
    lidar.m
    "Mass of the whole robot";

  parameter WheeledRobotSensors sensorParameters
    "Numbers of the sensors"
    annotation (Placement(transformation(extent={{-110, -412}, {-90, -392}})));

  replaceable Links.Base_link base_link(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"base_link\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-72, -36}, {-52, -16}})));

  replaceable Links.Caster_fork caster_fork(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"caster_fork\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-24, -36}, {-4, -16}})));

  replaceable Links.Caster_wheel caster_wheel(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"caster_wheel\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{24, -36}, {44, -16}})));

  replaceable Links.Wheel_left wheel_left(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"wheel_left\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-24, -114}, {-4, -94}})));

  replaceable Links.Wheel_right wheel_right(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"wheel_right\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-24, -192}, {-4, -172}})));

  replaceable Links.Column_guide column_guide(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"column_guide\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-24, -270}, {-4, -250}})));

  replaceable Links.Column column(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"column\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{24, -270}, {44, -250}})));

  replaceable Links.Neck neck(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"neck\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{72, -270}, {92, -250}})));

  replaceable Links.Head head(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"head\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{120, -270}, {140, -250}})));

  replaceable Links.Camera_optical_frame camera_optical_frame(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"camera_optical_frame\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{168, -270}, {188, -250}})));

  replaceable Links.Lidar_mast lidar_mast(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"lidar_mast\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-24, -348}, {-4, -328}})));

  replaceable Links.Lidar lidar(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"lidar\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{24, -348}, {44, -328}})));

  replaceable Joints.Caster_swivel caster_swivel(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"caster_swivel\" from link \"base_link\" to link \"caster_fork\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -10}, {-36, 10}})));

  replaceable Joints.Caster_roll caster_roll(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"caster_roll\" from link \"caster_fork\" to link \"caster_wheel\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-8, -10}, {12, 10}})));

  replaceable Joints.Drive_left drive_left(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"drive_left\" from link \"base_link\" to link \"wheel_left\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -88}, {-36, -68}})));

  replaceable Joints.Drive_right drive_right(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"drive_right\" from link \"base_link\" to link \"wheel_right\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -166}, {-36, -146}})));

  replaceable Joints.Guide_mount guide_mount constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"guide_mount\" from link \"base_link\" to link \"column_guide\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -244}, {-36, -224}})));

  replaceable Joints.Lift lift(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Prismatic joint \"lift\" from link \"column_guide\" to link \"column\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-8, -244}, {12, -224}})));

  replaceable Joints.Head_pan head_pan(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"head_pan\" from link \"column\" to link \"neck\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{40, -244}, {60, -224}})));

  replaceable Joints.Head_tilt head_tilt(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"head_tilt\" from link \"neck\" to link \"head\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{88, -244}, {108, -224}})));

  replaceable Joints.Camera_mount camera_mount constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"camera_mount\" from link \"head\" to link \"camera_optical_frame\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{136, -244}, {156, -224}})));

  replaceable Joints.Mast_mount mast_mount constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"mast_mount\" from link \"base_link\" to link \"lidar_mast\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -322}, {-36, -302}})));

  replaceable Joints.Lidar_spin lidar_spin(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"lidar_spin\" from link \"lidar_mast\" to link \"lidar\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-8, -322}, {12, -302}})));

  UrdfSync.Sensors.Lidar lidar_sensor(parameters = sensorParameters.lidar_sensor)
    "Sensor \"lidar\" of link \"lidar\""
    annotation (Placement(transformation(extent={{24, -376}, {44, -356}})));

equation
  connect(frame_a, base_link.frame_a)
    annotation (Line(points={{-100, 0}, {-76, 0}, {-76, -26}, {-72, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, caster_swivel.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, 0}, {-56, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_swivel.frame_b, caster_fork.frame_a)
    annotation (Line(points={{-36, 0}, {-28, 0}, {-28, -26}, {-24, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, drive_left.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -78}, {-56, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_left.frame_b, wheel_left.frame_a)
    annotation (Line(points={{-36, -78}, {-28, -78}, {-28, -104}, {-24, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, drive_right.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -156}, {-56, -156}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_right.frame_b, wheel_right.frame_a)
    annotation (Line(points={{-36, -156}, {-28, -156}, {-28, -182}, {-24, -182}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, guide_mount.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -234}, {-56, -234}}, color={95, 95, 95}, thickness=0.5));
  connect(guide_mount.frame_b, column_guide.frame_a)
    annotation (Line(points={{-36, -234}, {-28, -234}, {-28, -260}, {-24, -260}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, mast_mount.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -312}, {-56, -312}}, color={95, 95, 95}, thickness=0.5));
  connect(mast_mount.frame_b, lidar_mast.frame_a)
    annotation (Line(points={{-36, -312}, {-28, -312}, {-28, -338}, {-24, -338}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_fork.frame_a, caster_roll.frame_a)
    annotation (Line(points={{-24, -26}, {-28, -26}, {-28, 0}, {-8, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_roll.frame_b, caster_wheel.frame_a)
    annotation (Line(points={{12, 0}, {20, 0}, {20, -26}, {24, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_wheel.frame_a, caster_wheelFrame)
    annotation (Line(points={{24, -26}, {20, -26}, {20, 0}, {50, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(wheel_left.frame_a, wheel_leftFrame)
    annotation (Line(points={{-24, -104}, {-28, -104}, {-28, -78}, {2, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(wheel_right.frame_a, wheel_rightFrame)
    annotation (Line(points={{-24, -182}, {-28, -182}, {-28, -156}, {2, -156}}, color={95, 95, 95}, thickness=0.5));
  connect(column_guide.frame_a, lift.frame_a)
    annotation (Line(points={{-24, -260}, {-28, -260}, {-28, -234}, {-8, -234}}, color={95, 95, 95}, thickness=0.5));
  connect(lift.frame_b, column.frame_a)
    annotation (Line(points={{12, -234}, {20, -234}, {20, -260}, {24, -260}}, color={95, 95, 95}, thickness=0.5));
  connect(column.frame_a, head_pan.frame_a)
    annotation (Line(points={{24, -260}, {20, -260}, {20, -234}, {40, -234}}, color={95, 95, 95}, thickness=0.5));
  connect(head_pan.frame_b, neck.frame_a)
    annotation (Line(points={{60, -234}, {68, -234}, {68, -260}, {72, -260}}, color={95, 95, 95}, thickness=0.5));
  connect(neck.frame_a, head_tilt.frame_a)
    annotation (Line(points={{72, -260}, {68, -260}, {68, -234}, {88, -234}}, color={95, 95, 95}, thickness=0.5));
  connect(head_tilt.frame_b, head.frame_a)
    annotation (Line(points={{108, -234}, {116, -234}, {116, -260}, {120, -260}}, color={95, 95, 95}, thickness=0.5));
  connect(head.frame_a, camera_mount.frame_a)
    annotation (Line(points={{120, -260}, {116, -260}, {116, -234}, {136, -234}}, color={95, 95, 95}, thickness=0.5));
  connect(camera_mount.frame_b, camera_optical_frame.frame_a)
    annotation (Line(points={{156, -234}, {164, -234}, {164, -260}, {168, -260}}, color={95, 95, 95}, thickness=0.5));
  connect(camera_optical_frame.frame_a, camera_optical_frameFrame)
    annotation (Line(points={{168, -260}, {164, -260}, {164, -234}, {194, -234}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar_mast.frame_a, lidar_spin.frame_a)
    annotation (Line(points={{-24, -338}, {-28, -338}, {-28, -312}, {-8, -312}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar_spin.frame_b, lidar.frame_a)
    annotation (Line(points={{12, -312}, {20, -312}, {20, -338}, {24, -338}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar.frame_a, lidarFrame)
    annotation (Line(points={{24, -338}, {20, -338}, {20, -312}, {50, -312}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar.frame_a, lidar_sensor.frame_a)
    annotation (Line(points={{24, -338}, {20, -338}, {20, -366}, {24, -366}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar_sensor.frame_b, lidar_sensorFrame)
    annotation (Line(points={{44, -366}, {54, -366}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_swivel.axis, caster_swivelAxis)
    annotation (Line(points={{-46, 10}, {-46, 20}}, color={0, 0, 0}));
  connect(caster_swivel.support, caster_swivelSupport)
    annotation (Line(points={{-52, 10}, {-52, 12}, {-60, 12}, {-60, 20}}, color={0, 0, 0}));
  connect(caster_roll.axis, caster_rollAxis)
    annotation (Line(points={{2, 10}, {2, 20}}, color={0, 0, 0}));
  connect(caster_roll.support, caster_rollSupport)
    annotation (Line(points={{-4, 10}, {-4, 12}, {-12, 12}, {-12, 20}}, color={0, 0, 0}));
  connect(drive_left.axis, drive_leftAxis)
    annotation (Line(points={{-46, -68}, {-46, -58}}, color={0, 0, 0}));
  connect(drive_left.support, drive_leftSupport)
    annotation (Line(points={{-52, -68}, {-52, -66}, {-60, -66}, {-60, -58}}, color={0, 0, 0}));
  connect(drive_right.axis, drive_rightAxis)
    annotation (Line(points={{-46, -146}, {-46, -136}}, color={0, 0, 0}));
  connect(drive_right.support, drive_rightSupport)
    annotation (Line(points={{-52, -146}, {-52, -144}, {-60, -144}, {-60, -136}}, color={0, 0, 0}));
  connect(lift.axis, liftAxis)
    annotation (Line(points={{2, -224}, {2, -214}}, color={0, 127, 0}));
  connect(lift.support, liftSupport)
    annotation (Line(points={{-4, -224}, {-4, -222}, {-12, -222}, {-12, -214}}, color={0, 127, 0}));
  connect(head_pan.axis, head_panAxis)
    annotation (Line(points={{50, -224}, {50, -214}}, color={0, 0, 0}));
  connect(head_pan.support, head_panSupport)
    annotation (Line(points={{44, -224}, {44, -222}, {36, -222}, {36, -214}}, color={0, 0, 0}));
  connect(head_tilt.axis, head_tiltAxis)
    annotation (Line(points={{98, -224}, {98, -214}}, color={0, 0, 0}));
  connect(head_tilt.support, head_tiltSupport)
    annotation (Line(points={{92, -224}, {92, -222}, {84, -222}, {84, -214}}, color={0, 0, 0}));
  connect(lidar_spin.axis, lidar_spinAxis)
    annotation (Line(points={{2, -302}, {2, -292}}, color={0, 0, 0}));
  connect(lidar_spin.support, lidar_spinSupport)
    annotation (Line(points={{-4, -302}, {-4, -300}, {-12, -300}, {-12, -292}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 270}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 270}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 246}, {0, 264}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="caster_swivel"),
      Text(extent={{-90, 226}, {0, 244}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="caster_roll"),
      Text(extent={{-90, 206}, {0, 224}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="drive_left"),
      Text(extent={{-90, 186}, {0, 204}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="drive_right"),
      Text(extent={{-90, 166}, {0, 184}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="lift"),
      Text(extent={{-90, 146}, {0, 164}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="head_pan"),
      Text(extent={{-90, 126}, {0, 144}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="head_tilt"),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="lidar_spin"),
      Text(extent={{0, 253}, {88, 267}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="caster_wheel"),
      Text(extent={{0, 233}, {88, 247}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="wheel_left"),
      Text(extent={{0, 213}, {88, 227}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="wheel_right"),
      Text(extent={{0, 193}, {88, 207}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="camera_optical_frame"),
      Text(extent={{0, 173}, {88, 187}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="lidar"),
      Text(extent={{0, 153}, {88, 167}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="lidar")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -412}, {228, 34}})),
    Documentation(info="<html>
<p>
Links and joints of robot WheeledRobot, connected. Each can be exchanged in a model that extends this one. A drive of joint <code>elbow</code>, say, is connected to <code>elbowAxis</code> and <code>elbowSupport</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end WheeledRobot;
