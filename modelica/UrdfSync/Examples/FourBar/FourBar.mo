within UrdfSync.Examples.FourBar;

model FourBar "Robot FourBar"
  extends UrdfSync.Robots.PartialStationaryRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b couplerFrame
    "Frame of link \"coupler\""
    annotation (Placement(transformation(extent={{40, -10}, {60, 10}}), iconTransformation(extent={{92, 152}, {108, 168}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b rockerFrame
    "Frame of link \"rocker\""
    annotation (Placement(transformation(extent={{-8, -88}, {12, -68}}), iconTransformation(extent={{92, 132}, {108, 148}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a crank_pivotAxis
    "Axis of joint \"crank_pivot\""
    annotation (Placement(transformation(extent={{-52, 14}, {-40, 26}}), iconTransformation(extent={{-104, 156}, {-96, 164}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b crank_pivotSupport
    "Housing of the drive of joint \"crank_pivot\""
    annotation (Placement(transformation(extent={{-66, 14}, {-54, 26}}), iconTransformation(extent={{-104, 146}, {-96, 154}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a crank_pinAxis
    "Axis of joint \"crank_pin\""
    annotation (Placement(transformation(extent={{-4, 14}, {8, 26}}), iconTransformation(extent={{-104, 136}, {-96, 144}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b crank_pinSupport
    "Housing of the drive of joint \"crank_pin\""
    annotation (Placement(transformation(extent={{-18, 14}, {-6, 26}}), iconTransformation(extent={{-104, 126}, {-96, 134}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a rocker_pivotAxis
    "Axis of joint \"rocker_pivot\""
    annotation (Placement(transformation(extent={{-52, -64}, {-40, -52}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rocker_pivotSupport
    "Housing of the drive of joint \"rocker_pivot\""
    annotation (Placement(transformation(extent={{-66, -64}, {-54, -52}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

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
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-72, -36}, {-52, -16}})));

  replaceable Links.Crank crank(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"crank\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-24, -36}, {-4, -16}})));

  replaceable Links.Coupler coupler(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"coupler\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{24, -36}, {44, -16}})));

  replaceable Links.Rocker rocker(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"rocker\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-24, -114}, {-4, -94}})));

  replaceable Joints.Crank_pivot crank_pivot(
    phi_start = startPositions.crank_pivot,
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = startPositions.crank_pivot,
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"crank_pivot\" from link \"frame\" to link \"crank\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -10}, {-36, 10}})));

  replaceable Joints.Crank_pin crank_pin(
    phi_start = startPositions.crank_pin,
    fixedStart = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = startPositions.crank_pin,
      fixedStart = false,
      checkLimits = checkLimits)
    "Continuous joint \"crank_pin\" from link \"crank\" to link \"coupler\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-8, -10}, {12, 10}})));

  replaceable Joints.Rocker_pivot rocker_pivot(
    phi_start = startPositions.rocker_pivot,
    fixedStart = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = startPositions.rocker_pivot,
      fixedStart = false,
      checkLimits = checkLimits)
    "Continuous joint \"rocker_pivot\" from link \"frame\" to link \"rocker\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-56, -88}, {-36, -68}})));

  replaceable Joints.Rocker_pin rocker_pin constrainedby UrdfSync.Interfaces.PartialLoop
    "Revolute joint \"rocker_pin\" that closes a loop from link \"coupler\" to link \"rocker\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{24, -150}, {44, -130}})));

equation
  connect(frame_a, frame.frame_a)
    annotation (Line(points={{-100, 0}, {-76, 0}, {-76, -26}, {-72, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(frame.frame_a, crank_pivot.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, 0}, {-56, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(crank_pivot.frame_b, crank.frame_a)
    annotation (Line(points={{-36, 0}, {-28, 0}, {-28, -26}, {-24, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(frame.frame_a, rocker_pivot.frame_a)
    annotation (Line(points={{-72, -26}, {-76, -26}, {-76, -78}, {-56, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(rocker_pivot.frame_b, rocker.frame_a)
    annotation (Line(points={{-36, -78}, {-28, -78}, {-28, -104}, {-24, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(crank.frame_a, crank_pin.frame_a)
    annotation (Line(points={{-24, -26}, {-28, -26}, {-28, 0}, {-8, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(crank_pin.frame_b, coupler.frame_a)
    annotation (Line(points={{12, 0}, {20, 0}, {20, -26}, {24, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(coupler.frame_a, couplerFrame)
    annotation (Line(points={{24, -26}, {20, -26}, {20, 0}, {50, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(rocker.frame_a, rockerFrame)
    annotation (Line(points={{-24, -104}, {-28, -104}, {-28, -78}, {2, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(coupler.frame_a, rocker_pin.frame_a)
    annotation (Line(points={{24, -26}, {16, -26}, {16, -140}, {24, -140}}, color={95, 95, 95}, thickness=0.5));
  connect(rocker_pin.frame_b, rocker.frame_a)
    annotation (Line(points={{44, -140}, {48, -140}, {48, -154}, {-32, -154}, {-32, -104}, {-24, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(crank_pivot.axis, crank_pivotAxis)
    annotation (Line(points={{-46, 10}, {-46, 20}}, color={0, 0, 0}));
  connect(crank_pivot.support, crank_pivotSupport)
    annotation (Line(points={{-52, 10}, {-52, 12}, {-60, 12}, {-60, 20}}, color={0, 0, 0}));
  connect(crank_pin.axis, crank_pinAxis)
    annotation (Line(points={{2, 10}, {2, 20}}, color={0, 0, 0}));
  connect(crank_pin.support, crank_pinSupport)
    annotation (Line(points={{-4, 10}, {-4, 12}, {-12, 12}, {-12, 20}}, color={0, 0, 0}));
  connect(rocker_pivot.axis, rocker_pivotAxis)
    annotation (Line(points={{-46, -68}, {-46, -58}}, color={0, 0, 0}));
  connect(rocker_pivot.support, rocker_pivotSupport)
    annotation (Line(points={{-52, -68}, {-52, -66}, {-60, -66}, {-60, -58}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 170}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 170}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 146}, {0, 164}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="crank_pivot"),
      Text(extent={{-90, 126}, {0, 144}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="crank_pin"),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="rocker_pivot"),
      Text(extent={{0, 153}, {88, 167}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="coupler"),
      Text(extent={{0, 133}, {88, 147}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="rocker")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -158}, {84, 34}})),
    Documentation(info="<html>
<p>
Links and joints of robot FourBar, connected. Each can be exchanged in a model that extends this one. A drive of joint <code>elbow</code>, say, is connected to <code>elbowAxis</code> and <code>elbowSupport</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end FourBar;
