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
    annotation (Placement(transformation(extent={{18, 34}, {38, 54}}), iconTransformation(extent={{-70, 90}, {-50, 110}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rotationalSupport[7]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{66, 34}, {86, 54}}), iconTransformation(extent={{-40, 90}, {-20, 110}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a translationalAxis[1]
    "Drives"
    annotation (Placement(transformation(extent={{114, 34}, {134, 54}}), iconTransformation(extent={{20, 90}, {40, 110}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b translationalSupport[1]
    "Housings of the drives"
    annotation (Placement(transformation(extent={{162, 34}, {182, 54}}), iconTransformation(extent={{50, 90}, {70, 110}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b[5]
    "Frames of the links without children"
    annotation (Placement(transformation(extent={{240, -16}, {272, 16}}), iconTransformation(extent={{84, -16}, {116, 16}})));

  Links.Base_link base_link(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"base_link\""
    annotation (Placement(transformation(extent={{-72, -36}, {-52, -16}})));

  Links.Caster_fork caster_fork(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"caster_fork\""
    annotation (Placement(transformation(extent={{-24, -36}, {-4, -16}})));

  Links.Caster_wheel caster_wheel(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"caster_wheel\""
    annotation (Placement(transformation(extent={{24, -36}, {44, -16}})));

  Links.Wheel_left wheel_left(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"wheel_left\""
    annotation (Placement(transformation(extent={{-24, -106}, {-4, -86}})));

  Links.Wheel_right wheel_right(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"wheel_right\""
    annotation (Placement(transformation(extent={{-24, -176}, {-4, -156}})));

  Links.Column_guide column_guide(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"column_guide\""
    annotation (Placement(transformation(extent={{-24, -254}, {-4, -234}})));

  Links.Column column(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"column\""
    annotation (Placement(transformation(extent={{24, -254}, {44, -234}})));

  Links.Neck neck(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"neck\""
    annotation (Placement(transformation(extent={{72, -254}, {92, -234}})));

  Links.Head head(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"head\""
    annotation (Placement(transformation(extent={{120, -254}, {140, -234}})));

  Links.Camera_optical_frame camera_optical_frame(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"camera_optical_frame\""
    annotation (Placement(transformation(extent={{168, -254}, {188, -234}})));

  Links.Lidar_mast lidar_mast(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"lidar_mast\""
    annotation (Placement(transformation(extent={{-24, -324}, {-4, -304}})));

  Links.Lidar lidar(
    animation = animation,
    showCollisions = showCollisions)
    "Link \"lidar\""
    annotation (Placement(transformation(extent={{24, -324}, {44, -304}})));

  Joints.Caster_swivel caster_swivel(
    axisNumber = 1,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[1],
    w_start = w_start[1])
    "Continuous joint \"caster_swivel\" from link \"base_link\" to link \"caster_fork\""
    annotation (Placement(transformation(extent={{-56, -10}, {-36, 10}})));

  Joints.Caster_roll caster_roll(
    axisNumber = 2,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[2],
    w_start = w_start[2])
    "Continuous joint \"caster_roll\" from link \"caster_fork\" to link \"caster_wheel\""
    annotation (Placement(transformation(extent={{-8, -10}, {12, 10}})));

  Joints.Drive_left drive_left(
    axisNumber = 3,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[3],
    w_start = w_start[3])
    "Continuous joint \"drive_left\" from link \"base_link\" to link \"wheel_left\""
    annotation (Placement(transformation(extent={{-56, -80}, {-36, -60}})));

  Joints.Drive_right drive_right(
    axisNumber = 4,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[4],
    w_start = w_start[4])
    "Continuous joint \"drive_right\" from link \"base_link\" to link \"wheel_right\""
    annotation (Placement(transformation(extent={{-56, -150}, {-36, -130}})));

  Joints.Guide_mount guide_mount
    "Fixed joint \"guide_mount\" from link \"base_link\" to link \"column_guide\""
    annotation (Placement(transformation(extent={{-56, -228}, {-36, -208}})));

  Joints.Lift lift(
    axisNumber = 1,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    s_start = s_start[1],
    v_start = v_start[1])
    "Prismatic joint \"lift\" from link \"column_guide\" to link \"column\""
    annotation (Placement(transformation(extent={{-8, -228}, {12, -208}})));

  Joints.Head_pan head_pan(
    axisNumber = 5,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[5],
    w_start = w_start[5])
    "Revolute joint \"head_pan\" from link \"column\" to link \"neck\""
    annotation (Placement(transformation(extent={{40, -228}, {60, -208}})));

  Joints.Head_tilt head_tilt(
    axisNumber = 6,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[6],
    w_start = w_start[6])
    "Revolute joint \"head_tilt\" from link \"neck\" to link \"head\""
    annotation (Placement(transformation(extent={{88, -228}, {108, -208}})));

  Joints.Camera_mount camera_mount
    "Fixed joint \"camera_mount\" from link \"head\" to link \"camera_optical_frame\""
    annotation (Placement(transformation(extent={{136, -228}, {156, -208}})));

  Joints.Mast_mount mast_mount
    "Fixed joint \"mast_mount\" from link \"base_link\" to link \"lidar_mast\""
    annotation (Placement(transformation(extent={{-56, -298}, {-36, -278}})));

  Joints.Lidar_spin lidar_spin(
    axisNumber = 7,
    checkLimits = checkLimits,
    fixedStart = fixedStart,
    phi_start = phi_start[7],
    w_start = w_start[7])
    "Continuous joint \"lidar_spin\" from link \"lidar_mast\" to link \"lidar\""
    annotation (Placement(transformation(extent={{-8, -298}, {12, -278}})));

equation
  connect(frame_a, base_link.frame_a)
    annotation (Line(points={{-100, 0}, {-76, 0}, {-76, -26}, {-72, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, caster_swivel.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, 0}, {-56, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_swivel.frame_b, caster_fork.frame_a)
    annotation (Line(points={{-36, 0}, {-28, 0}, {-28, -26}, {-24, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, drive_left.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -70}, {-56, -70}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_left.frame_b, wheel_left.frame_a)
    annotation (Line(points={{-36, -70}, {-28, -70}, {-28, -96}, {-24, -96}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, drive_right.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -140}, {-56, -140}}, color={95, 95, 95}, thickness=0.5));
  connect(drive_right.frame_b, wheel_right.frame_a)
    annotation (Line(points={{-36, -140}, {-28, -140}, {-28, -166}, {-24, -166}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, guide_mount.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -218}, {-56, -218}}, color={95, 95, 95}, thickness=0.5));
  connect(guide_mount.frame_b, column_guide.frame_a)
    annotation (Line(points={{-36, -218}, {-28, -218}, {-28, -244}, {-24, -244}}, color={95, 95, 95}, thickness=0.5));
  connect(base_link.frame_a, mast_mount.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -288}, {-56, -288}}, color={95, 95, 95}, thickness=0.5));
  connect(mast_mount.frame_b, lidar_mast.frame_a)
    annotation (Line(points={{-36, -288}, {-28, -288}, {-28, -314}, {-24, -314}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_fork.frame_a, caster_roll.frame_a)
    annotation (Line(points={{-24, -26}, {-28, -26}, {-28, 0}, {-8, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_roll.frame_b, caster_wheel.frame_a)
    annotation (Line(points={{12, 0}, {20, 0}, {20, -26}, {24, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_wheel.frame_a, frame_b[1])
    annotation (Line(points={{24, -26}, {20, -26}, {20, 0}, {256, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(wheel_left.frame_a, frame_b[2])
    annotation (Line(points={{-24, -96}, {-28, -96}, {-28, -70}, {232, -70}, {232, 0}, {256, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(wheel_right.frame_a, frame_b[3])
    annotation (Line(points={{-24, -166}, {-28, -166}, {-28, -140}, {232, -140}, {232, 0}, {256, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(column_guide.frame_a, lift.frame_a)
    annotation (Line(points={{-24, -244}, {-28, -244}, {-28, -218}, {-8, -218}}, color={95, 95, 95}, thickness=0.5));
  connect(lift.frame_b, column.frame_a)
    annotation (Line(points={{12, -218}, {20, -218}, {20, -244}, {24, -244}}, color={95, 95, 95}, thickness=0.5));
  connect(column.frame_a, head_pan.frame_a)
    annotation (Line(points={{24, -244}, {20, -244}, {20, -218}, {40, -218}}, color={95, 95, 95}, thickness=0.5));
  connect(head_pan.frame_b, neck.frame_a)
    annotation (Line(points={{60, -218}, {68, -218}, {68, -244}, {72, -244}}, color={95, 95, 95}, thickness=0.5));
  connect(neck.frame_a, head_tilt.frame_a)
    annotation (Line(points={{72, -244}, {68, -244}, {68, -218}, {88, -218}}, color={95, 95, 95}, thickness=0.5));
  connect(head_tilt.frame_b, head.frame_a)
    annotation (Line(points={{108, -218}, {116, -218}, {116, -244}, {120, -244}}, color={95, 95, 95}, thickness=0.5));
  connect(head.frame_a, camera_mount.frame_a)
    annotation (Line(points={{120, -244}, {116, -244}, {116, -218}, {136, -218}}, color={95, 95, 95}, thickness=0.5));
  connect(camera_mount.frame_b, camera_optical_frame.frame_a)
    annotation (Line(points={{156, -218}, {164, -218}, {164, -244}, {168, -244}}, color={95, 95, 95}, thickness=0.5));
  connect(camera_optical_frame.frame_a, frame_b[4])
    annotation (Line(points={{168, -244}, {164, -244}, {164, -218}, {232, -218}, {232, 0}, {256, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar_mast.frame_a, lidar_spin.frame_a)
    annotation (Line(points={{-24, -314}, {-28, -314}, {-28, -288}, {-8, -288}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar_spin.frame_b, lidar.frame_a)
    annotation (Line(points={{12, -288}, {20, -288}, {20, -314}, {24, -314}}, color={95, 95, 95}, thickness=0.5));
  connect(lidar.frame_a, frame_b[5])
    annotation (Line(points={{24, -314}, {20, -314}, {20, -288}, {232, -288}, {232, 0}, {256, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(caster_swivel.axis, rotationalAxis[1])
    annotation (Line(points={{-46, 10}, {-46, 18}, {28, 18}, {28, 44}}, color={0, 0, 0}));
  connect(caster_swivel.support, rotationalSupport[1])
    annotation (Line(points={{-52, 10}, {-52, 22}, {76, 22}, {76, 44}}, color={0, 0, 0}));
  connect(caster_roll.axis, rotationalAxis[2])
    annotation (Line(points={{2, 10}, {2, 18}, {28, 18}, {28, 44}}, color={0, 0, 0}));
  connect(caster_roll.support, rotationalSupport[2])
    annotation (Line(points={{-4, 10}, {-4, 22}, {76, 22}, {76, 44}}, color={0, 0, 0}));
  connect(drive_left.axis, rotationalAxis[3])
    annotation (Line(points={{-46, -60}, {-46, -52}, {226, -52}, {226, 18}, {28, 18}, {28, 44}}, color={0, 0, 0}));
  connect(drive_left.support, rotationalSupport[3])
    annotation (Line(points={{-52, -60}, {-52, -48}, {220, -48}, {220, 22}, {76, 22}, {76, 44}}, color={0, 0, 0}));
  connect(drive_right.axis, rotationalAxis[4])
    annotation (Line(points={{-46, -130}, {-46, -122}, {226, -122}, {226, 18}, {28, 18}, {28, 44}}, color={0, 0, 0}));
  connect(drive_right.support, rotationalSupport[4])
    annotation (Line(points={{-52, -130}, {-52, -118}, {220, -118}, {220, 22}, {76, 22}, {76, 44}}, color={0, 0, 0}));
  connect(lift.axis, translationalAxis[1])
    annotation (Line(points={{2, -208}, {2, -192}, {214, -192}, {214, 26}, {124, 26}, {124, 44}}, color={0, 127, 0}));
  connect(lift.support, translationalSupport[1])
    annotation (Line(points={{-4, -208}, {-4, -188}, {208, -188}, {208, 30}, {172, 30}, {172, 44}}, color={0, 127, 0}));
  connect(head_pan.axis, rotationalAxis[5])
    annotation (Line(points={{50, -208}, {50, -200}, {226, -200}, {226, 18}, {28, 18}, {28, 44}}, color={0, 0, 0}));
  connect(head_pan.support, rotationalSupport[5])
    annotation (Line(points={{44, -208}, {44, -196}, {220, -196}, {220, 22}, {76, 22}, {76, 44}}, color={0, 0, 0}));
  connect(head_tilt.axis, rotationalAxis[6])
    annotation (Line(points={{98, -208}, {98, -200}, {226, -200}, {226, 18}, {28, 18}, {28, 44}}, color={0, 0, 0}));
  connect(head_tilt.support, rotationalSupport[6])
    annotation (Line(points={{92, -208}, {92, -196}, {220, -196}, {220, 22}, {76, 22}, {76, 44}}, color={0, 0, 0}));
  connect(lidar_spin.axis, rotationalAxis[7])
    annotation (Line(points={{2, -278}, {2, -270}, {226, -270}, {226, 18}, {28, 18}, {28, 44}}, color={0, 0, 0}));
  connect(lidar_spin.support, rotationalSupport[7])
    annotation (Line(points={{-4, -278}, {-4, -266}, {220, -266}, {220, 22}, {76, 22}, {76, 44}}, color={0, 0, 0}));

  annotation (
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -332}, {272, 54}})),
    Documentation(info="<html>
<p>
Links and joints of robot WheeledRobot, connected. The flange vectors hold the axes that can be driven; the constants <code>...Axis</code> and <code>...Frame</code> are their numbers, and keep their meaning when the robot changes. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end WheeledRobot;
