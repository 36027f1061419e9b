within UrdfSync.Examples.FourBar;

model FourBar "Robot FourBar"
  extends UrdfSync.Robots.PartialStationaryRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b couplerFrame
    "Frame of link \"coupler\""
    annotation (Placement(transformation(extent={{76, -10}, {96, 10}}), iconTransformation(extent={{92, 132}, {108, 148}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b rockerFrame
    "Frame of link \"rocker\""
    annotation (Placement(transformation(extent={{16, -88}, {36, -68}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a crank_pivotAxis
    "Axis of joint \"crank_pivot\""
    annotation (Placement(transformation(extent={{-40, 14}, {-28, 26}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b crank_pivotSupport
    "Housing of the drive of joint \"crank_pivot\""
    annotation (Placement(transformation(extent={{-54, 14}, {-42, 26}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a crank_pinAxis
    "Axis of joint \"crank_pin\""
    annotation (Placement(transformation(extent={{20, 14}, {32, 26}}), iconTransformation(extent={{-104, 176}, {-96, 184}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b crank_pinSupport
    "Housing of the drive of joint \"crank_pin\""
    annotation (Placement(transformation(extent={{6, 14}, {18, 26}}), iconTransformation(extent={{-104, 166}, {-96, 174}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a rocker_pivotAxis
    "Axis of joint \"rocker_pivot\""
    annotation (Placement(transformation(extent={{-40, -64}, {-28, -52}}), iconTransformation(extent={{-104, 136}, {-96, 144}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rocker_pivotSupport
    "Housing of the drive of joint \"rocker_pivot\""
    annotation (Placement(transformation(extent={{-54, -64}, {-42, -52}}), iconTransformation(extent={{-104, 126}, {-96, 134}})));

  final parameter Modelica.Units.SI.Mass m =
    frame.m +
    crank.m +
    coupler.m +
    rocker.m
    "Mass of the whole robot";

  parameter FourBarStart startPositions
    "Where joints begin"
    annotation (Placement(transformation(extent={{-110, -158}, {-90, -138}})));

  replaceable Links.Frame frame(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"frame\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-60, -36}, {-40, -16}})));

  replaceable Links.Crank crank(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"crank\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -36}, {20, -16}})));

  replaceable Links.Coupler coupler(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"coupler\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -36}, {80, -16}})));

  replaceable Links.Rocker rocker(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"rocker\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -114}, {20, -94}})));

  replaceable Joints.Crank_pivot crank_pivot(
    phi_start = startPositions.crank_pivot,
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = startPositions.crank_pivot,
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"crank_pivot\" from link \"frame\" to link \"crank\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -10}, {-24, 10}})));

  replaceable Joints.Crank_pin crank_pin(
    phi_start = startPositions.crank_pin,
    fixedStart = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = startPositions.crank_pin,
      fixedStart = false,
      checkLimits = checkLimits)
    "Continuous joint \"crank_pin\" from link \"crank\" to link \"coupler\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -10}, {36, 10}})));

  replaceable Joints.Rocker_pivot rocker_pivot(
    phi_start = startPositions.rocker_pivot,
    fixedStart = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = startPositions.rocker_pivot,
      fixedStart = false,
      checkLimits = checkLimits)
    "Continuous joint \"rocker_pivot\" from link \"frame\" to link \"rocker\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -88}, {-24, -68}})));

  replaceable Joints.Rocker_pin rocker_pin constrainedby UrdfSync.Interfaces.PartialLoop
    "Revolute joint \"rocker_pin\" that closes a loop from link \"coupler\" to link \"rocker\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -150}, {80, -130}})));

equation
  connect(frame_a, frame.frame_a)
    annotation (Line(points={{-100, 0}, {-64, 0}, {-64, -26}, {-60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(frame.frame_a, crank_pivot.frame_a)
    annotation (Line(points={{-60, -26}, {-64, -26}, {-64, 0}, {-44, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(crank_pivot.frame_b, crank.frame_a)
    annotation (Line(points={{-24, 0}, {-4, 0}, {-4, -26}, {0, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(frame.frame_a, rocker_pivot.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -78}, {-44, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(rocker_pivot.frame_b, rocker.frame_a)
    annotation (Line(points={{-24, -78}, {-4, -78}, {-4, -104}, {0, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(crank.frame_a, crank_pin.frame_a)
    annotation (Line(points={{0, -26}, {-4, -26}, {-4, 0}, {16, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(crank_pin.frame_b, coupler.frame_a)
    annotation (Line(points={{36, 0}, {56, 0}, {56, -26}, {60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(coupler.frame_a, couplerFrame)
    annotation (Line(points={{60, -26}, {56, -26}, {56, 0}, {86, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(rocker.frame_a, rockerFrame)
    annotation (Line(points={{0, -104}, {-4, -104}, {-4, -78}, {26, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(coupler.frame_a, rocker_pin.frame_a)
    annotation (Line(points={{60, -26}, {52, -26}, {52, -140}, {60, -140}}, color={95, 95, 95}, thickness=0.5));
  connect(rocker_pin.frame_b, rocker.frame_a)
    annotation (Line(points={{80, -140}, {84, -140}, {84, -154}, {-8, -154}, {-8, -104}, {0, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(crank_pivot.axis, crank_pivotAxis)
    annotation (Line(points={{-34, 10}, {-34, 20}}, color={0, 0, 0}));
  connect(crank_pivot.support, crank_pivotSupport)
    annotation (Line(points={{-40, 10}, {-40, 12}, {-48, 12}, {-48, 20}}, color={0, 0, 0}));
  connect(crank_pin.axis, crank_pinAxis)
    annotation (Line(points={{26, 10}, {26, 20}}, color={0, 0, 0}));
  connect(crank_pin.support, crank_pinSupport)
    annotation (Line(points={{20, 10}, {20, 12}, {12, 12}, {12, 20}}, color={0, 0, 0}));
  connect(rocker_pivot.axis, rocker_pivotAxis)
    annotation (Line(points={{-34, -68}, {-34, -58}}, color={0, 0, 0}));
  connect(rocker_pivot.support, rocker_pivotSupport)
    annotation (Line(points={{-40, -68}, {-40, -66}, {-48, -66}, {-48, -58}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 190}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 190}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="crank_pivot"),
      Text(extent={{-90, 166}, {0, 184}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="crank_pin"),
      Text(extent={{-90, 126}, {0, 144}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="rocker_pivot"),
      Text(extent={{0, 133}, {88, 147}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="coupler"),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="rocker")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -158}, {120, 34}})),
    Documentation(info="<html>
<p>
Links and joints of robot FourBar, connected. Each can be exchanged in a model that extends this one. Each joint that can be driven has two flanges for its drive: its name with <code>Axis</code> and with <code>Support</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "18d63be1-3d0d", base = "5f01b50cea507008"));
end FourBar;
