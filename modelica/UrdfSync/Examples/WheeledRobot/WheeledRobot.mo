within UrdfSync.Examples.WheeledRobot;

model WheeledRobot "Robot WheeledRobot"
  extends UrdfSync.Robots.PartialMobileRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b caster_wheelFrame
    "Frame of link \"caster_wheel\""
    annotation (Placement(transformation(extent={{76, -88}, {96, -68}}), iconTransformation(extent={{92, 172}, {108, 188}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b wheel_leftFrame
    "Frame of link \"wheel_left\""
    annotation (Placement(transformation(extent={{16, -244}, {36, -224}}), iconTransformation(extent={{92, 132}, {108, 148}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b wheel_rightFrame
    "Frame of link \"wheel_right\""
    annotation (Placement(transformation(extent={{16, -400}, {36, -380}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b camera_optical_frameFrame
    "Frame of link \"camera_optical_frame\""
    annotation (Placement(transformation(extent={{256, -10}, {276, 10}}), iconTransformation(extent={{92, 212}, {108, 228}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b lidarFrame
    "Frame of link \"lidar\""
    annotation (Placement(transformation(extent={{76, -166}, {96, -146}}), iconTransformation(extent={{92, 192}, {108, 208}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b lidar_sensor_5be26fFrame
    "Frame of sensor \"lidar\""
    annotation (Placement(transformation(extent={{84, -240}, {96, -228}}), iconTransformation(extent={{92, 152}, {108, 168}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a caster_swivelAxis
    "Axis of joint \"caster_swivel\""
    annotation (Placement(transformation(extent={{-40, -64}, {-28, -52}}), iconTransformation(extent={{-104, 176}, {-96, 184}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b caster_swivelSupport
    "Housing of the drive of joint \"caster_swivel\""
    annotation (Placement(transformation(extent={{-54, -64}, {-42, -52}}), iconTransformation(extent={{-104, 166}, {-96, 174}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a caster_rollAxis
    "Axis of joint \"caster_roll\""
    annotation (Placement(transformation(extent={{20, -64}, {32, -52}}), iconTransformation(extent={{-104, 196}, {-96, 204}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b caster_rollSupport
    "Housing of the drive of joint \"caster_roll\""
    annotation (Placement(transformation(extent={{6, -64}, {18, -52}}), iconTransformation(extent={{-104, 186}, {-96, 194}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a drive_leftAxis
    "Axis of joint \"drive_left\""
    annotation (Placement(transformation(extent={{-40, -220}, {-28, -208}}), iconTransformation(extent={{-104, 156}, {-96, 164}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b drive_leftSupport
    "Housing of the drive of joint \"drive_left\""
    annotation (Placement(transformation(extent={{-54, -220}, {-42, -208}}), iconTransformation(extent={{-104, 146}, {-96, 154}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a drive_rightAxis
    "Axis of joint \"drive_right\""
    annotation (Placement(transformation(extent={{-40, -376}, {-28, -364}}), iconTransformation(extent={{-104, 136}, {-96, 144}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b drive_rightSupport
    "Housing of the drive of joint \"drive_right\""
    annotation (Placement(transformation(extent={{-54, -376}, {-42, -364}}), iconTransformation(extent={{-104, 126}, {-96, 134}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a liftAxis
    "Axis of joint \"lift\""
    annotation (Placement(transformation(extent={{20, 14}, {32, 26}}), iconTransformation(extent={{-104, 256}, {-96, 264}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b liftSupport
    "Housing of the drive of joint \"lift\""
    annotation (Placement(transformation(extent={{6, 14}, {18, 26}}), iconTransformation(extent={{-104, 246}, {-96, 254}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a head_panAxis
    "Axis of joint \"head_pan\""
    annotation (Placement(transformation(extent={{80, 14}, {92, 26}}), iconTransformation(extent={{-104, 216}, {-96, 224}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b head_panSupport
    "Housing of the drive of joint \"head_pan\""
    annotation (Placement(transformation(extent={{66, 14}, {78, 26}}), iconTransformation(extent={{-104, 206}, {-96, 214}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a head_tiltAxis
    "Axis of joint \"head_tilt\""
    annotation (Placement(transformation(extent={{140, 14}, {152, 26}}), iconTransformation(extent={{-104, 236}, {-96, 244}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b head_tiltSupport
    "Housing of the drive of joint \"head_tilt\""
    annotation (Placement(transformation(extent={{126, 14}, {138, 26}}), iconTransformation(extent={{-104, 226}, {-96, 234}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a lidar_spinAxis
    "Axis of joint \"lidar_spin\""
    annotation (Placement(transformation(extent={{20, -142}, {32, -130}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b lidar_spinSupport
    "Housing of the drive of joint \"lidar_spin\""
    annotation (Placement(transformation(extent={{6, -142}, {18, -130}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

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
    annotation (Placement(transformation(extent={{-110, -462}, {-90, -442}})));

  replaceable Links.Base_link base_link(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"base_link\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-60, -36}, {-40, -16}})));

  replaceable Links.Caster_fork caster_fork(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"caster_fork\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -114}, {20, -94}})));

  replaceable Links.Caster_wheel caster_wheel(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"caster_wheel\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -114}, {80, -94}})));

  replaceable Links.Wheel_left wheel_left(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"wheel_left\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -270}, {20, -250}})));

  replaceable Links.Wheel_right wheel_right(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"wheel_right\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -426}, {20, -406}})));

  replaceable Links.Column_guide column_guide(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"column_guide\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -36}, {20, -16}})));

  replaceable Links.Column column(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"column\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -36}, {80, -16}})));

  replaceable Links.Neck neck(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"neck\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{120, -36}, {140, -16}})));

  replaceable Links.Head head(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"head\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{180, -36}, {200, -16}})));

  replaceable Links.Camera_optical_frame camera_optical_frame(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"camera_optical_frame\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{240, -36}, {260, -16}})));

  replaceable Links.Lidar_mast lidar_mast(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"lidar_mast\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -192}, {20, -172}})));

  replaceable Links.Lidar lidar(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"lidar\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -192}, {80, -172}})));

  replaceable Joints.Caster_swivel caster_swivel(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"caster_swivel\" from link \"base_link\" to link \"caster_fork\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -88}, {-24, -68}})));

  replaceable Joints.Caster_roll caster_roll(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"caster_roll\" from link \"caster_fork\" to link \"caster_wheel\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -88}, {36, -68}})));

  replaceable Joints.Drive_left drive_left(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"drive_left\" from link \"base_link\" to link \"wheel_left\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -244}, {-24, -224}})));

  replaceable Joints.Drive_right drive_right(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"drive_right\" from link \"base_link\" to link \"wheel_right\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -400}, {-24, -380}})));

  replaceable Joints.Guide_mount guide_mount constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"guide_mount\" from link \"base_link\" to link \"column_guide\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -10}, {-24, 10}})));

  replaceable Joints.Lift lift(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Prismatic joint \"lift\" from link \"column_guide\" to link \"column\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -10}, {36, 10}})));

  replaceable Joints.Head_pan head_pan(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"head_pan\" from link \"column\" to link \"neck\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{76, -10}, {96, 10}})));

  replaceable Joints.Head_tilt head_tilt(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"head_tilt\" from link \"neck\" to link \"head\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{136, -10}, {156, 10}})));

  replaceable Joints.Camera_mount camera_mount constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"camera_mount\" from link \"head\" to link \"camera_optical_frame\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{196, -10}, {216, 10}})));

  replaceable Joints.Mast_mount mast_mount constrainedby UrdfSync.Interfaces.PartialFixedJoint
    "Fixed joint \"mast_mount\" from link \"base_link\" to link \"lidar_mast\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -166}, {-24, -146}})));

  replaceable Joints.Lidar_spin lidar_spin(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"lidar_spin\" from link \"lidar_mast\" to link \"lidar\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -166}, {36, -146}})));

  UrdfSync.Sensors.Lidar lidar_sensor_5be26f(parameters = sensorParameters.lidar_sensor_5be26f)
    "Sensor \"lidar\" of link \"lidar\""
    annotation (Placement(transformation(extent={{60, -244}, {80, -224}})));

equation
  connect(frame_a, base_link.frame_a)
    annotation (Line(points={{-100, 0}, {-64, 0}, {-64, -26}, {-60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, caster_swivel.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -78}, {-44, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_swivel.frame_b, caster_fork.frame_a)
    annotation (Line(points={{-24, -78}, {-4, -78}, {-4, -104}, {0, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, drive_left.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -234}, {-44, -234}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_left.frame_b, wheel_left.frame_a)
    annotation (Line(points={{-24, -234}, {-4, -234}, {-4, -260}, {0, -260}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, drive_right.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -390}, {-44, -390}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_right.frame_b, wheel_right.frame_a)
    annotation (Line(points={{-24, -390}, {-4, -390}, {-4, -416}, {0, -416}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, guide_mount.frame_a)
    annotation (Line(points={{-60, -26}, {-64, -26}, {-64, 0}, {-44, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(guide_mount.frame_b, column_guide.frame_a)
    annotation (Line(points={{-24, 0}, {-4, 0}, {-4, -26}, {0, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, mast_mount.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -156}, {-44, -156}}, color={95, 95, 95}, thickness=0.5));
  connect(mast_mount.frame_b, lidar_mast.frame_a)
    annotation (Line(points={{-24, -156}, {-4, -156}, {-4, -182}, {0, -182}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_fork.frame_a, caster_roll.frame_a)
    annotation (Line(points={{0, -104}, {-4, -104}, {-4, -78}, {16, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_roll.frame_b, caster_wheel.frame_a)
    annotation (Line(points={{36, -78}, {56, -78}, {56, -104}, {60, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_wheel.frame_a, caster_wheelFrame)
    annotation (Line(points={{60, -104}, {56, -104}, {56, -78}, {86, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(wheel_left.frame_a, wheel_leftFrame)
    annotation (Line(points={{0, -260}, {-4, -260}, {-4, -234}, {26, -234}}, color={95, 95, 95}, thickness=0.5));
  connect(wheel_right.frame_a, wheel_rightFrame)
    annotation (Line(points={{0, -416}, {-4, -416}, {-4, -390}, {26, -390}}, color={95, 95, 95}, thickness=0.5));
  connect(column_guide.frame_a, lift.frame_a)
    annotation (Line(points={{0, -26}, {-4, -26}, {-4, 0}, {16, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(lift.frame_b, column.frame_a)
    annotation (Line(points={{36, 0}, {56, 0}, {56, -26}, {60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(column.frame_a, head_pan.frame_a)
    annotation (Line(points={{60, -26}, {56, -26}, {56, 0}, {76, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(head_pan.frame_b, neck.frame_a)
    annotation (Line(points={{96, 0}, {116, 0}, {116, -26}, {120, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(neck.frame_a, head_tilt.frame_a)
    annotation (Line(points={{120, -26}, {116, -26}, {116, 0}, {136, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(head_tilt.frame_b, head.frame_a)
    annotation (Line(points={{156, 0}, {176, 0}, {176, -26}, {180, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(head.frame_a, camera_mount.frame_a)
    annotation (Line(points={{180, -26}, {176, -26}, {176, 0}, {196, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(camera_mount.frame_b, camera_optical_frame.frame_a)
    annotation (Line(points={{216, 0}, {236, 0}, {236, -26}, {240, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(camera_optical_frame.frame_a, camera_optical_frameFrame)
    annotation (Line(points={{240, -26}, {236, -26}, {236, 0}, {266, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar_mast.frame_a, lidar_spin.frame_a)
    annotation (Line(points={{0, -182}, {-4, -182}, {-4, -156}, {16, -156}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar_spin.frame_b, lidar.frame_a)
    annotation (Line(points={{36, -156}, {56, -156}, {56, -182}, {60, -182}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar.frame_a, lidarFrame)
    annotation (Line(points={{60, -182}, {56, -182}, {56, -156}, {86, -156}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar.frame_a, lidar_sensor_5be26f.frame_a)
    annotation (Line(points={{60, -182}, {52, -182}, {52, -234}, {60, -234}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar_sensor_5be26f.frame_b, lidar_sensor_5be26fFrame)
    annotation (Line(points={{80, -234}, {90, -234}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_swivel.axis, caster_swivelAxis)
    annotation (Line(points={{-34, -68}, {-34, -58}}, color={0, 0, 0}));
  connect(caster_swivel.support, caster_swivelSupport)
    annotation (Line(points={{-40, -68}, {-40, -66}, {-48, -66}, {-48, -58}}, color={0, 0, 0}));
  connect(caster_roll.axis, caster_rollAxis)
    annotation (Line(points={{26, -68}, {26, -58}}, color={0, 0, 0}));
  connect(caster_roll.support, caster_rollSupport)
    annotation (Line(points={{20, -68}, {20, -66}, {12, -66}, {12, -58}}, color={0, 0, 0}));
  connect(drive_left.axis, drive_leftAxis)
    annotation (Line(points={{-34, -224}, {-34, -214}}, color={0, 0, 0}));
  connect(drive_left.support, drive_leftSupport)
    annotation (Line(points={{-40, -224}, {-40, -222}, {-48, -222}, {-48, -214}}, color={0, 0, 0}));
  connect(drive_right.axis, drive_rightAxis)
    annotation (Line(points={{-34, -380}, {-34, -370}}, color={0, 0, 0}));
  connect(drive_right.support, drive_rightSupport)
    annotation (Line(points={{-40, -380}, {-40, -378}, {-48, -378}, {-48, -370}}, color={0, 0, 0}));
  connect(lift.axis, liftAxis)
    annotation (Line(points={{26, 10}, {26, 20}}, color={0, 127, 0}));
  connect(lift.support, liftSupport)
    annotation (Line(points={{20, 10}, {20, 12}, {12, 12}, {12, 20}}, color={0, 127, 0}));
  connect(head_pan.axis, head_panAxis)
    annotation (Line(points={{86, 10}, {86, 20}}, color={0, 0, 0}));
  connect(head_pan.support, head_panSupport)
    annotation (Line(points={{80, 10}, {80, 12}, {72, 12}, {72, 20}}, color={0, 0, 0}));
  connect(head_tilt.axis, head_tiltAxis)
    annotation (Line(points={{146, 10}, {146, 20}}, color={0, 0, 0}));
  connect(head_tilt.support, head_tiltSupport)
    annotation (Line(points={{140, 10}, {140, 12}, {132, 12}, {132, 20}}, color={0, 0, 0}));
  connect(lidar_spin.axis, lidar_spinAxis)
    annotation (Line(points={{26, -146}, {26, -136}}, color={0, 0, 0}));
  connect(lidar_spin.support, lidar_spinSupport)
    annotation (Line(points={{20, -146}, {20, -144}, {12, -144}, {12, -136}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 270}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 270}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 166}, {0, 184}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="caster_swivel"),
      Text(extent={{-90, 186}, {0, 204}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="caster_roll"),
      Text(extent={{-90, 146}, {0, 164}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="drive_left"),
      Text(extent={{-90, 126}, {0, 144}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="drive_right"),
      Text(extent={{-90, 246}, {0, 264}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="lift"),
      Text(extent={{-90, 206}, {0, 224}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="head_pan"),
      Text(extent={{-90, 226}, {0, 244}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="head_tilt"),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="lidar_spin"),
      Text(extent={{0, 173}, {88, 187}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="caster_wheel"),
      Text(extent={{0, 133}, {88, 147}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="wheel_left"),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="wheel_right"),
      Text(extent={{0, 213}, {88, 227}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="camera_optical_frame"),
      Text(extent={{0, 193}, {88, 207}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="lidar"),
      Text(extent={{0, 153}, {88, 167}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="lidar")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -462}, {300, 34}})),
    Documentation(info="<html>
<p>
Links and joints of robot WheeledRobot, connected. Each can be exchanged in a model that extends this one. Each joint that can be driven has two flanges for its drive: its name with <code>Axis</code> and with <code>Support</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-3d0d", base = "63c0a1b195040c4b"));
end WheeledRobot;
