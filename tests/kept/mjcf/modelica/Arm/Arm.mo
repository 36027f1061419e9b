within Arm;

model Arm "Robot Arm"
  extends UrdfSync.Robots.PartialStationaryRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b foreFrame
    "Frame of link \"fore\""
    annotation (Placement(transformation(extent={{76, -10}, {96, 10}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a shoulderAxis
    "Axis of joint \"shoulder\""
    annotation (Placement(transformation(extent={{-40, 14}, {-28, 26}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b shoulderSupport
    "Housing of the drive of joint \"shoulder\""
    annotation (Placement(transformation(extent={{-54, 14}, {-42, 26}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a elbowAxis
    "Axis of joint \"elbow\""
    annotation (Placement(transformation(extent={{20, 14}, {32, 26}}), iconTransformation(extent={{-104, 176}, {-96, 184}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b elbowSupport
    "Housing of the drive of joint \"elbow\""
    annotation (Placement(transformation(extent={{6, 14}, {18, 26}}), iconTransformation(extent={{-104, 166}, {-96, 174}})));

  final parameter Modelica.Units.SI.Mass m =
    worldLink.m +
    upper.m +
    fore.m
    "Mass of the whole robot";

  replaceable Links.WorldLink worldLink(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"world\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-60, -36}, {-40, -16}})));

  replaceable Links.Upper upper(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"upper\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -36}, {20, -16}})));

  replaceable Links.Fore fore(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"fore\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -36}, {80, -16}})));

  replaceable Joints.Shoulder shoulder(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"shoulder\" from link \"world\" to link \"upper\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -10}, {-24, 10}})));

  replaceable Joints.Elbow elbow(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"elbow\" from link \"upper\" to link \"fore\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -10}, {36, 10}})));

equation
  connect(frame_a, worldLink.frame_a)
    annotation (Line(points={{-100, 0}, {-64, 0}, {-64, -26}, {-60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(worldLink.frame_a, shoulder.frame_a)
    annotation (Line(points={{-60, -26}, {-64, -26}, {-64, 0}, {-44, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(shoulder.frame_b, upper.frame_a)
    annotation (Line(points={{-24, 0}, {-4, 0}, {-4, -26}, {0, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(upper.frame_a, elbow.frame_a)
    annotation (Line(points={{0, -26}, {-4, -26}, {-4, 0}, {16, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow.frame_b, fore.frame_a)
    annotation (Line(points={{36, 0}, {56, 0}, {56, -26}, {60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(fore.frame_a, foreFrame)
    annotation (Line(points={{60, -26}, {56, -26}, {56, 0}, {86, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(shoulder.axis, shoulderAxis)
    annotation (Line(points={{-34, 10}, {-34, 20}}, color={0, 0, 0}));
  connect(shoulder.support, shoulderSupport)
    annotation (Line(points={{-40, 10}, {-40, 12}, {-48, 12}, {-48, 20}}, color={0, 0, 0}));
  connect(elbow.axis, elbowAxis)
    annotation (Line(points={{26, 10}, {26, 20}}, color={0, 0, 0}));
  connect(elbow.support, elbowSupport)
    annotation (Line(points={{20, 10}, {20, 12}, {12, 12}, {12, 20}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 190}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 190}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="shoulder"),
      Text(extent={{-90, 166}, {0, 184}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="elbow"),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="fore")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -44}, {120, 34}})),
    Documentation(info="<html>
<p>
Links and joints of robot Arm, connected. Each can be exchanged in a model that extends this one. Each joint that can be driven has two flanges for its drive: its name with <code>Axis</code> and with <code>Support</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-3d0d", base = "1ac383fb30fb5cce"));
end Arm;
