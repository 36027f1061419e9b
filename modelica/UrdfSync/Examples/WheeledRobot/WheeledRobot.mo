within UrdfSync.Examples.WheeledRobot;

model WheeledRobot "Robot WheeledRobot"
  extends UrdfSync.Robots.PartialMobileRobot;

  constant Integer caster_swivelAxis = 1
    "Number of joint \"caster_swivel\" in rotationalAxis";

  constant Integer caster_rollAxis = 2
    "Number of joint \"caster_roll\" in rotationalAxis";

  constant Integer drive_leftAxis = 3
    "Number of joint \"drive_left\" in rotationalAxis";

  constant Integer drive_rightAxis = 4
    "Number of joint \"drive_right\" in rotationalAxis";

  constant Integer head_panAxis = 5
    "Number of joint \"head_pan\" in rotationalAxis";

  constant Integer head_tiltAxis = 6
    "Number of joint \"head_tilt\" in rotationalAxis";

  constant Integer lidar_spinAxis = 7
    "Number of joint \"lidar_spin\" in rotationalAxis";

  constant Integer liftAxis = 1
    "Number of joint \"lift\" in translationalAxis";

  constant Integer caster_wheelFrame = 1
    "Number of link \"caster_wheel\" in frame_b";

  constant Integer wheel_leftFrame = 2
    "Number of link \"wheel_left\" in frame_b";

  constant Integer wheel_rightFrame = 3
    "Number of link \"wheel_right\" in frame_b";

  constant Integer camera_optical_frameFrame = 4
    "Number of link \"camera_optical_frame\" in frame_b";

  constant Integer lidarFrame = 5
    "Number of link \"lidar\" in frame_b";

  final parameter Real rotationalRange[7, 3] = {
    {-Modelica.Constants.inf, Modelica.Constants.inf, caster_swivel.parameters.limits.velocity},
    {-Modelica.Constants.inf, Modelica.Constants.inf, caster_roll.parameters.limits.velocity},
    {-Modelica.Constants.inf, Modelica.Constants.inf, drive_left.parameters.limits.velocity},
    {-Modelica.Constants.inf, Modelica.Constants.inf, drive_right.parameters.limits.velocity},
    {head_pan.parameters.limits.lower, head_pan.parameters.limits.upper, head_pan.parameters.limits.velocity},
    {head_tilt.parameters.limits.lower, head_tilt.parameters.limits.upper, head_tilt.parameters.limits.velocity},
    {-Modelica.Constants.inf, Modelica.Constants.inf, lidar_spin.parameters.limits.velocity}}
    "Ranges of rotationalAxis, those of joints that follow an axis included: {lower, upper, velocity}";

  parameter Modelica.Units.SI.Angle phi_start[7] = {
    UrdfSync.Functions.closestToZero(rotationalRange[1, 1], rotationalRange[1, 2]),
    UrdfSync.Functions.closestToZero(rotationalRange[2, 1], rotationalRange[2, 2]),
    UrdfSync.Functions.closestToZero(rotationalRange[3, 1], rotationalRange[3, 2]),
    UrdfSync.Functions.closestToZero(rotationalRange[4, 1], rotationalRange[4, 2]),
    UrdfSync.Functions.closestToZero(rotationalRange[5, 1], rotationalRange[5, 2]),
    UrdfSync.Functions.closestToZero(rotationalRange[6, 1], rotationalRange[6, 2]),
    UrdfSync.Functions.closestToZero(rotationalRange[7, 1], rotationalRange[7, 2])}
    "Start values of the positions"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.AngularVelocity w_start[7] = zeros(7)
    "Start values of the speeds"
    annotation (Dialog(tab="Initialization"));

  final parameter Real translationalRange[1, 3] = {
    {lift.parameters.limits.lower, lift.parameters.limits.upper, lift.parameters.limits.velocity}}
    "Ranges of translationalAxis, those of joints that follow an axis included: {lower, upper, velocity}";

  parameter Modelica.Units.SI.Position s_start[1] = {
    UrdfSync.Functions.closestToZero(translationalRange[1, 1], translationalRange[1, 2])}
    "Start values of the positions"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Velocity v_start[1] = zeros(1)
    "Start values of the speeds"
    annotation (Dialog(tab="Initialization"));

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

  Modelica.Mechanics.Rotational.Interfaces.Flange_a rotationalAxis[7]
    "Drives"
    annotation (Placement(transformation(extent={{-60, 174}, {-40, 194}}), iconTransformation(extent={{-70, 90}, {-50, 110}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rotationalSupport[7]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{-12, 174}, {8, 194}}), iconTransformation(extent={{-40, 90}, {-20, 110}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a translationalAxis[1]
    "Drives"
    annotation (Placement(transformation(extent={{36, 174}, {56, 194}}), iconTransformation(extent={{20, 90}, {40, 110}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b translationalSupport[1]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{84, 174}, {104, 194}}), iconTransformation(extent={{50, 90}, {70, 110}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b[5]
    "Frames of the links without children"
    annotation (Placement(transformation(extent={{162, 124}, {194, 156}}), iconTransformation(extent={{84, -16}, {116, 16}})));

  Links.Base_link base_link(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"base_link\""
    annotation (Placement(transformation(extent={{-150, 104}, {-130, 124}})));

  Links.Caster_fork caster_fork(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"caster_fork\""
    annotation (Placement(transformation(extent={{-102, 104}, {-82, 124}})));

  Links.Caster_wheel caster_wheel(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"caster_wheel\""
    annotation (Placement(transformation(extent={{-54, 104}, {-34, 124}})));

  Links.Wheel_left wheel_left(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"wheel_left\""
    annotation (Placement(transformation(extent={{-102, 34}, {-82, 54}})));

  Links.Wheel_right wheel_right(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"wheel_right\""
    annotation (Placement(transformation(extent={{-102, -36}, {-82, -16}})));

  Links.Column_guide column_guide(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"column_guide\""
    annotation (Placement(transformation(extent={{-102, -114}, {-82, -94}})));

  Links.Column column(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"column\""
    annotation (Placement(transformation(extent={{-54, -114}, {-34, -94}})));

  Links.Neck neck(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"neck\""
    annotation (Placement(transformation(extent={{-6, -114}, {14, -94}})));

  Links.Head head(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"head\""
    annotation (Placement(transformation(extent={{42, -114}, {62, -94}})));

  Links.Camera_optical_frame camera_optical_frame(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"camera_optical_frame\""
    annotation (Placement(transformation(extent={{90, -114}, {110, -94}})));

  Links.Lidar_mast lidar_mast(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"lidar_mast\""
    annotation (Placement(transformation(extent={{-102, -184}, {-82, -164}})));

  Links.Lidar lidar(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"lidar\""
    annotation (Placement(transformation(extent={{-54, -184}, {-34, -164}})));

  Joints.Caster_swivel caster_swivel(
    axisNumber = 1,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[1],
    w_start = w_start[1])
    "Continuous joint \"caster_swivel\" from link \"base_link\" to link \"caster_fork\""
    annotation (Placement(transformation(extent={{-134, 130}, {-114, 150}})));

  Joints.Caster_roll caster_roll(
    axisNumber = 2,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[2],
    w_start = w_start[2])
    "Continuous joint \"caster_roll\" from link \"caster_fork\" to link \"caster_wheel\""
    annotation (Placement(transformation(extent={{-86, 130}, {-66, 150}})));

  Joints.Drive_left drive_left(
    axisNumber = 3,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[3],
    w_start = w_start[3])
    "Continuous joint \"drive_left\" from link \"base_link\" to link \"wheel_left\""
    annotation (Placement(transformation(extent={{-134, 60}, {-114, 80}})));

  Joints.Drive_right drive_right(
    axisNumber = 4,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[4],
    w_start = w_start[4])
    "Continuous joint \"drive_right\" from link \"base_link\" to link \"wheel_right\""
    annotation (Placement(transformation(extent={{-134, -10}, {-114, 10}})));

  Joints.Guide_mount guide_mount
    "Fixed joint \"guide_mount\" from link \"base_link\" to link \"column_guide\""
    annotation (Placement(transformation(extent={{-134, -88}, {-114, -68}})));

  Joints.Lift lift(
    axisNumber = 1,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    s_start = s_start[1],
    v_start = v_start[1])
    "Prismatic joint \"lift\" from link \"column_guide\" to link \"column\""
    annotation (Placement(transformation(extent={{-86, -88}, {-66, -68}})));

  Joints.Head_pan head_pan(
    axisNumber = 5,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[5],
    w_start = w_start[5])
    "Revolute joint \"head_pan\" from link \"column\" to link \"neck\""
    annotation (Placement(transformation(extent={{-38, -88}, {-18, -68}})));

  Joints.Head_tilt head_tilt(
    axisNumber = 6,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[6],
    w_start = w_start[6])
    "Revolute joint \"head_tilt\" from link \"neck\" to link \"head\""
    annotation (Placement(transformation(extent={{10, -88}, {30, -68}})));

  Joints.Camera_mount camera_mount
    "Fixed joint \"camera_mount\" from link \"head\" to link \"camera_optical_frame\""
    annotation (Placement(transformation(extent={{58, -88}, {78, -68}})));

  Joints.Mast_mount mast_mount
    "Fixed joint \"mast_mount\" from link \"base_link\" to link \"lidar_mast\""
    annotation (Placement(transformation(extent={{-134, -158}, {-114, -138}})));

  Joints.Lidar_spin lidar_spin(
    axisNumber = 7,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[7],
    w_start = w_start[7])
    "Continuous joint \"lidar_spin\" from link \"lidar_mast\" to link \"lidar\""
    annotation (Placement(transformation(extent={{-86, -158}, {-66, -138}})));

equation
  connect(frame_a, base_link.frame_a)
    annotation (Line(points={{-178, 140}, {-154, 140}, {-154, 114}, {-150, 114}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, caster_swivel.frame_a)
    annotation (Line(points={{-150, 114}, {-154, 114}, {-154, 140}, {-134, 140}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_swivel.frame_b, caster_fork.frame_a)
    annotation (Line(points={{-114, 140}, {-106, 140}, {-106, 114}, {-102, 114}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, drive_left.frame_a)
    annotation (Line(points={{-150, 114}, {-154, 114}, {-154, 70}, {-134, 70}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_left.frame_b, wheel_left.frame_a)
    annotation (Line(points={{-114, 70}, {-106, 70}, {-106, 44}, {-102, 44}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, drive_right.frame_a)
    annotation (Line(points={{-150, 114}, {-154, 114}, {-154, 0}, {-134, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_right.frame_b, wheel_right.frame_a)
    annotation (Line(points={{-114, 0}, {-106, 0}, {-106, -26}, {-102, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, guide_mount.frame_a)
    annotation (Line(points={{-150, 114}, {-154, 114}, {-154, -78}, {-134, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(guide_mount.frame_b, column_guide.frame_a)
    annotation (Line(points={{-114, -78}, {-106, -78}, {-106, -104}, {-102, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, mast_mount.frame_a)
    annotation (Line(points={{-150, 114}, {-154, 114}, {-154, -148}, {-134, -148}}, color={95, 95, 95}, thickness=0.5));
  connect(mast_mount.frame_b, lidar_mast.frame_a)
    annotation (Line(points={{-114, -148}, {-106, -148}, {-106, -174}, {-102, -174}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_fork.frame_a, caster_roll.frame_a)
    annotation (Line(points={{-102, 114}, {-106, 114}, {-106, 140}, {-86, 140}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_roll.frame_b, caster_wheel.frame_a)
    annotation (Line(points={{-66, 140}, {-58, 140}, {-58, 114}, {-54, 114}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_wheel.frame_a, frame_b[1])
    annotation (Line(points={{-54, 114}, {-58, 114}, {-58, 140}, {178, 140}}, color={95, 95, 95}, thickness=0.5));
  connect(wheel_left.frame_a, frame_b[2])
    annotation (Line(points={{-102, 44}, {-106, 44}, {-106, 70}, {154, 70}, {154, 140}, {178, 140}}, color={95, 95, 95}, thickness=0.5));
  connect(wheel_right.frame_a, frame_b[3])
    annotation (Line(points={{-102, -26}, {-106, -26}, {-106, 0}, {154, 0}, {154, 140}, {178, 140}}, color={95, 95, 95}, thickness=0.5));
  connect(column_guide.frame_a, lift.frame_a)
    annotation (Line(points={{-102, -104}, {-106, -104}, {-106, -78}, {-86, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(lift.frame_b, column.frame_a)
    annotation (Line(points={{-66, -78}, {-58, -78}, {-58, -104}, {-54, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(column.frame_a, head_pan.frame_a)
    annotation (Line(points={{-54, -104}, {-58, -104}, {-58, -78}, {-38, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(head_pan.frame_b, neck.frame_a)
    annotation (Line(points={{-18, -78}, {-10, -78}, {-10, -104}, {-6, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(neck.frame_a, head_tilt.frame_a)
    annotation (Line(points={{-6, -104}, {-10, -104}, {-10, -78}, {10, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(head_tilt.frame_b, head.frame_a)
    annotation (Line(points={{30, -78}, {38, -78}, {38, -104}, {42, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(head.frame_a, camera_mount.frame_a)
    annotation (Line(points={{42, -104}, {38, -104}, {38, -78}, {58, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(camera_mount.frame_b, camera_optical_frame.frame_a)
    annotation (Line(points={{78, -78}, {86, -78}, {86, -104}, {90, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(camera_optical_frame.frame_a, frame_b[4])
    annotation (Line(points={{90, -104}, {86, -104}, {86, -78}, {154, -78}, {154, 140}, {178, 140}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar_mast.frame_a, lidar_spin.frame_a)
    annotation (Line(points={{-102, -174}, {-106, -174}, {-106, -148}, {-86, -148}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar_spin.frame_b, lidar.frame_a)
    annotation (Line(points={{-66, -148}, {-58, -148}, {-58, -174}, {-54, -174}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar.frame_a, frame_b[5])
    annotation (Line(points={{-54, -174}, {-58, -174}, {-58, -148}, {154, -148}, {154, 140}, {178, 140}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_swivel.axis, rotationalAxis[1])
    annotation (Line(points={{-124, 150}, {-124, 158}, {-50, 158}, {-50, 184}}, color={0, 0, 0}));
  connect(caster_swivel.support, rotationalSupport[1])
    annotation (Line(points={{-130, 150}, {-130, 162}, {-2, 162}, {-2, 184}}, color={0, 0, 0}));
  connect(caster_roll.axis, rotationalAxis[2])
    annotation (Line(points={{-76, 150}, {-76, 158}, {-50, 158}, {-50, 184}}, color={0, 0, 0}));
  connect(caster_roll.support, rotationalSupport[2])
    annotation (Line(points={{-82, 150}, {-82, 162}, {-2, 162}, {-2, 184}}, color={0, 0, 0}));
  connect(drive_left.axis, rotationalAxis[3])
    annotation (Line(points={{-124, 80}, {-124, 88}, {148, 88}, {148, 158}, {-50, 158}, {-50, 184}}, color={0, 0, 0}));
  connect(drive_left.support, rotationalSupport[3])
    annotation (Line(points={{-130, 80}, {-130, 92}, {142, 92}, {142, 162}, {-2, 162}, {-2, 184}}, color={0, 0, 0}));
  connect(drive_right.axis, rotationalAxis[4])
    annotation (Line(points={{-124, 10}, {-124, 18}, {148, 18}, {148, 158}, {-50, 158}, {-50, 184}}, color={0, 0, 0}));
  connect(drive_right.support, rotationalSupport[4])
    annotation (Line(points={{-130, 10}, {-130, 22}, {142, 22}, {142, 162}, {-2, 162}, {-2, 184}}, color={0, 0, 0}));
  connect(lift.axis, translationalAxis[1])
    annotation (Line(points={{-76, -68}, {-76, -52}, {136, -52}, {136, 166}, {46, 166}, {46, 184}}, color={0, 127, 0}));
  connect(lift.support, translationalSupport[1])
    annotation (Line(points={{-82, -68}, {-82, -48}, {130, -48}, {130, 170}, {94, 170}, {94, 184}}, color={0, 127, 0}));
  connect(head_pan.axis, rotationalAxis[5])
    annotation (Line(points={{-28, -68}, {-28, -60}, {148, -60}, {148, 158}, {-50, 158}, {-50, 184}}, color={0, 0, 0}));
  connect(head_pan.support, rotationalSupport[5])
    annotation (Line(points={{-34, -68}, {-34, -56}, {142, -56}, {142, 162}, {-2, 162}, {-2, 184}}, color={0, 0, 0}));
  connect(head_tilt.axis, rotationalAxis[6])
    annotation (Line(points={{20, -68}, {20, -60}, {148, -60}, {148, 158}, {-50, 158}, {-50, 184}}, color={0, 0, 0}));
  connect(head_tilt.support, rotationalSupport[6])
    annotation (Line(points={{14, -68}, {14, -56}, {142, -56}, {142, 162}, {-2, 162}, {-2, 184}}, color={0, 0, 0}));
  connect(lidar_spin.axis, rotationalAxis[7])
    annotation (Line(points={{-76, -138}, {-76, -130}, {148, -130}, {148, 158}, {-50, 158}, {-50, 184}}, color={0, 0, 0}));
  connect(lidar_spin.support, rotationalSupport[7])
    annotation (Line(points={{-82, -138}, {-82, -126}, {142, -126}, {142, 162}, {-2, 162}, {-2, 184}}, color={0, 0, 0}));

  annotation (
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-194, -192}, {194, 194}})),
    Documentation(info="<html>
<p>
Links and joints of robot WheeledRobot, connected. The flange vectors hold the axes that can be driven; the constants <code>...Axis</code> and <code>...Frame</code> are their numbers, and keep their meaning when the robot changes. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end WheeledRobot;
