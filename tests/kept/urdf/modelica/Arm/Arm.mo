within Arm;

model Arm "Robot Arm"
  extends UrdfSync.Robots.PartialStationaryRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b foreFrame
    "Frame of link \"fore\""
    annotation (Placement(transformation(extent={{16, -10}, {36, 10}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a elbowAxis
    "Axis of joint \"elbow\""
    annotation (Placement(transformation(extent={{-40, 14}, {-28, 26}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b elbowSupport
    "Housing of the drive of joint \"elbow\""
    annotation (Placement(transformation(extent={{-54, 14}, {-42, 26}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

  final parameter Modelica.Units.SI.Mass m =
    base.m +
    fore.m
    "Mass of the whole robot";

  replaceable Links.Base base(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"base\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-60, -36}, {-40, -16}})));

  replaceable Links.Fore fore(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"fore\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -36}, {20, -16}})));

  replaceable Joints.Elbow elbow(
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Revolute joint \"elbow\" from link \"base\" to link \"fore\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -10}, {-24, 10}})));

equation
  connect(frame_a, base.frame_a)
    annotation (Line(points={{-100, 0}, {-64, 0}, {-64, -26}, {-60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(base.frame_a, elbow.frame_a)
    annotation (Line(points={{-60, -26}, {-64, -26}, {-64, 0}, {-44, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow.frame_b, fore.frame_a)
    annotation (Line(points={{-24, 0}, {-4, 0}, {-4, -26}, {0, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(fore.frame_a, foreFrame)
    annotation (Line(points={{0, -26}, {-4, -26}, {-4, 0}, {26, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow.axis, elbowAxis)
    annotation (Line(points={{-34, 10}, {-34, 20}}, color={0, 0, 0}));
  connect(elbow.support, elbowSupport)
    annotation (Line(points={{-40, 10}, {-40, 12}, {-48, 12}, {-48, 20}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 130}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 130}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="elbow"),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="fore")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -44}, {60, 34}})),
    Documentation(info="<html>
<p>
Links and joints of robot Arm, connected. Each can be exchanged in a model that extends this one. Each joint that can be driven has two flanges for its drive: its name with <code>Axis</code> and with <code>Support</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-3d0d", base = "224ba0392f4f94e5"));
end Arm;
