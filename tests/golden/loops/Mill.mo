within Zoo.Mill;

model Mill "Robot Mill"
  extends UrdfSync.Robots.PartialMobileRobot;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b dieFrame
    "Frame of link \"die\""
    annotation (Placement(transformation(extent={{16, -10}, {36, 10}}), iconTransformation(extent={{92, 112}, {108, 128}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b barFrame
    "Frame of link \"bar\""
    annotation (Placement(transformation(extent={{76, -244}, {96, -224}}), iconTransformation(extent={{92, 172}, {108, 188}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b ringFrame
    "Frame of link \"ring\""
    annotation (Placement(transformation(extent={{76, -88}, {96, -68}}), iconTransformation(extent={{92, 192}, {108, 208}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b rodFrame
    "Frame of link \"rod\""
    annotation (Placement(transformation(extent={{76, -166}, {96, -146}}), iconTransformation(extent={{92, 132}, {108, 148}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b leverFrame
    "Frame of link \"lever\""
    annotation (Placement(transformation(extent={{16, -400}, {36, -380}}), iconTransformation(extent={{92, 152}, {108, 168}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a block_181fd7Axis
    "Axis of joint \"block\""
    annotation (Placement(transformation(extent={{-40, 14}, {-28, 26}}), iconTransformation(extent={{-104, 116}, {-96, 124}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b block_181fd7Support
    "Housing of the drive of joint \"block\""
    annotation (Placement(transformation(extent={{-54, 14}, {-42, 26}}), iconTransformation(extent={{-104, 106}, {-96, 114}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a crankAxis
    "Axis of joint \"crank\""
    annotation (Placement(transformation(extent={{-40, -220}, {-28, -208}}), iconTransformation(extent={{-104, 216}, {-96, 224}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b crankSupport
    "Housing of the drive of joint \"crank\""
    annotation (Placement(transformation(extent={{-54, -220}, {-42, -208}}), iconTransformation(extent={{-104, 206}, {-96, 214}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a arm_pinAxis
    "Axis of joint \"arm_pin\""
    annotation (Placement(transformation(extent={{20, -220}, {32, -208}}), iconTransformation(extent={{-104, 156}, {-96, 164}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b arm_pinSupport
    "Housing of the drive of joint \"arm_pin\""
    annotation (Placement(transformation(extent={{6, -220}, {18, -208}}), iconTransformation(extent={{-104, 146}, {-96, 154}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_a ramAxis
    "Axis of joint \"ram\""
    annotation (Placement(transformation(extent={{-40, -142}, {-28, -130}}), iconTransformation(extent={{-104, 176}, {-96, 184}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b ramSupport
    "Housing of the drive of joint \"ram\""
    annotation (Placement(transformation(extent={{-54, -142}, {-42, -130}}), iconTransformation(extent={{-104, 166}, {-96, 174}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a shoe_pinAxis
    "Axis of joint \"shoe_pin\""
    annotation (Placement(transformation(extent={{20, -142}, {32, -130}}), iconTransformation(extent={{-104, 196}, {-96, 204}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b shoe_pinSupport
    "Housing of the drive of joint \"shoe_pin\""
    annotation (Placement(transformation(extent={{6, -142}, {18, -130}}), iconTransformation(extent={{-104, 186}, {-96, 194}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a rockerAxis
    "Axis of joint \"rocker\""
    annotation (Placement(transformation(extent={{-40, -376}, {-28, -364}}), iconTransformation(extent={{-104, 136}, {-96, 144}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b rockerSupport
    "Housing of the drive of joint \"rocker\""
    annotation (Placement(transformation(extent={{-54, -376}, {-42, -364}}), iconTransformation(extent={{-104, 126}, {-96, 134}})));

  final parameter Modelica.Units.SI.Mass m =
    ground_32f49b.m +
    die.m +
    arm.m +
    bar.m +
    bob.m +
    ring.m +
    shoe.m +
    rod.m +
    lever.m
    "Mass of the whole robot";

  parameter MillStart startPositions
    "Where joints begin"
    annotation (Placement(transformation(extent={{-110, -506}, {-90, -486}})));

  replaceable Links.Ground_32f49b ground_32f49b(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"ground\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-60, -36}, {-40, -16}})));

  replaceable Links.Die die(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"die\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -36}, {20, -16}})));

  replaceable Links.Arm arm(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -270}, {20, -250}})));

  replaceable Links.Bar bar(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"bar\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -270}, {80, -250}})));

  replaceable Links.Bob bob(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"bob\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -114}, {20, -94}})));

  replaceable Links.Ring ring(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"ring\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -114}, {80, -94}})));

  replaceable Links.Shoe shoe(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"shoe\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -192}, {20, -172}})));

  replaceable Links.Rod rod(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"rod\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -192}, {80, -172}})));

  replaceable Links.Lever lever(
    animation = animation,
    showCollisions = showCollisions)
    constrainedby UrdfSync.Interfaces.PartialLink(
      animation = animation,
      showCollisions = showCollisions)
    "Link \"lever\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{0, -426}, {20, -406}})));

  replaceable Joints.Block_181fd7 block_181fd7(
    s_start = startPositions.block_181fd7,
    fixedStart = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_start = startPositions.block_181fd7,
      fixedStart = false,
      checkLimits = checkLimits)
    "Prismatic joint \"block\" from link \"ground\" to link \"die\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -10}, {-24, 10}})));

  replaceable Joints.Crank crank(
    phi_start = startPositions.crank,
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = startPositions.crank,
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Continuous joint \"crank\" from link \"ground\" to link \"arm\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -244}, {-24, -224}})));

  replaceable Joints.Arm_pin arm_pin(
    phi_start = startPositions.arm_pin,
    fixedStart = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = startPositions.arm_pin,
      fixedStart = false,
      checkLimits = checkLimits)
    "Continuous joint \"arm_pin\" from link \"arm\" to link \"bar\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -244}, {36, -224}})));

  replaceable Joints.Hook hook constrainedby UrdfSync.Interfaces.PartialBallJoint
    "Ball joint \"hook\" from link \"ground\" to link \"bob\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -88}, {-24, -68}})));

  replaceable Joints.Eye eye constrainedby UrdfSync.Interfaces.PartialBallJoint
    "Ball joint \"eye\" from link \"bob\" to link \"ring\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -88}, {36, -68}})));

  replaceable Joints.Ram ram(
    s_start = startPositions.ram,
    fixedStart = fixedStart,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialPrismaticJoint(
      s_start = startPositions.ram,
      fixedStart = fixedStart,
      checkLimits = checkLimits)
    "Prismatic joint \"ram\" from link \"ground\" to link \"shoe\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -166}, {-24, -146}})));

  replaceable Joints.Shoe_pin shoe_pin(
    phi_start = startPositions.shoe_pin,
    fixedStart = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = startPositions.shoe_pin,
      fixedStart = false,
      checkLimits = checkLimits)
    "Continuous joint \"shoe_pin\" from link \"shoe\" to link \"rod\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{16, -166}, {36, -146}})));

  replaceable Joints.Rocker rocker(
    phi_start = startPositions.rocker,
    fixedStart = false,
    checkLimits = checkLimits)
    constrainedby UrdfSync.Interfaces.PartialRevoluteJoint(
      phi_start = startPositions.rocker,
      fixedStart = false,
      checkLimits = checkLimits)
    "Revolute joint \"rocker\" from link \"ground\" to link \"lever\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-44, -400}, {-24, -380}})));

  replaceable Joints.Die_pin die_pin constrainedby UrdfSync.Interfaces.PartialLoop
    "Revolute joint \"die_pin\" that closes a loop from link \"rod\" to link \"die\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -462}, {80, -442}})));

  replaceable Joints.Lever_pin lever_pin constrainedby UrdfSync.Interfaces.PartialLoop
    "Revolute joint \"lever_pin\" that closes a loop from link \"bar\" to link \"lever\""
    annotation (choicesAllMatching=true, Placement(transformation(extent={{60, -498}, {80, -478}})));

equation
  connect(frame_a, ground_32f49b.frame_a)
    annotation (Line(points={{-100, 0}, {-64, 0}, {-64, -26}, {-60, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(ground_32f49b.frame_a, block_181fd7.frame_a)
    annotation (Line(points={{-60, -26}, {-64, -26}, {-64, 0}, {-44, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(block_181fd7.frame_b, die.frame_a)
    annotation (Line(points={{-24, 0}, {-4, 0}, {-4, -26}, {0, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(ground_32f49b.frame_a, crank.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -234}, {-44, -234}}, color={95, 95, 95}, thickness=0.5));
  connect(crank.frame_b, arm.frame_a)
    annotation (Line(points={{-24, -234}, {-4, -234}, {-4, -260}, {0, -260}}, color={95, 95, 95}, thickness=0.5));
  connect(ground_32f49b.frame_a, hook.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -78}, {-44, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(hook.frame_b, bob.frame_a)
    annotation (Line(points={{-24, -78}, {-4, -78}, {-4, -104}, {0, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(ground_32f49b.frame_a, ram.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -156}, {-44, -156}}, color={95, 95, 95}, thickness=0.5));
  connect(ram.frame_b, shoe.frame_a)
    annotation (Line(points={{-24, -156}, {-4, -156}, {-4, -182}, {0, -182}}, color={95, 95, 95}, thickness=0.5));
  connect(ground_32f49b.frame_a, rocker.frame_a)
    annotation (Line(points={{-60, -26}, {-68, -26}, {-68, -390}, {-44, -390}}, color={95, 95, 95}, thickness=0.5));
  connect(rocker.frame_b, lever.frame_a)
    annotation (Line(points={{-24, -390}, {-4, -390}, {-4, -416}, {0, -416}}, color={95, 95, 95}, thickness=0.5));
  connect(die.frame_a, dieFrame)
    annotation (Line(points={{0, -26}, {-4, -26}, {-4, 0}, {26, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(arm.frame_a, arm_pin.frame_a)
    annotation (Line(points={{0, -260}, {-4, -260}, {-4, -234}, {16, -234}}, color={95, 95, 95}, thickness=0.5));
  connect(arm_pin.frame_b, bar.frame_a)
    annotation (Line(points={{36, -234}, {56, -234}, {56, -260}, {60, -260}}, color={95, 95, 95}, thickness=0.5));
  connect(bar.frame_a, barFrame)
    annotation (Line(points={{60, -260}, {56, -260}, {56, -234}, {86, -234}}, color={95, 95, 95}, thickness=0.5));
  connect(bob.frame_a, eye.frame_a)
    annotation (Line(points={{0, -104}, {-4, -104}, {-4, -78}, {16, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(eye.frame_b, ring.frame_a)
    annotation (Line(points={{36, -78}, {56, -78}, {56, -104}, {60, -104}}, color={95, 95, 95}, thickness=0.5));
  connect(ring.frame_a, ringFrame)
    annotation (Line(points={{60, -104}, {56, -104}, {56, -78}, {86, -78}}, color={95, 95, 95}, thickness=0.5));
  connect(shoe.frame_a, shoe_pin.frame_a)
    annotation (Line(points={{0, -182}, {-4, -182}, {-4, -156}, {16, -156}}, color={95, 95, 95}, thickness=0.5));
  connect(shoe_pin.frame_b, rod.frame_a)
    annotation (Line(points={{36, -156}, {56, -156}, {56, -182}, {60, -182}}, color={95, 95, 95}, thickness=0.5));
  connect(rod.frame_a, rodFrame)
    annotation (Line(points={{60, -182}, {56, -182}, {56, -156}, {86, -156}}, color={95, 95, 95}, thickness=0.5));
  connect(lever.frame_a, leverFrame)
    annotation (Line(points={{0, -416}, {-4, -416}, {-4, -390}, {26, -390}}, color={95, 95, 95}, thickness=0.5));
  connect(rod.frame_a, die_pin.frame_a)
    annotation (Line(points={{60, -182}, {52, -182}, {52, -452}, {60, -452}}, color={95, 95, 95}, thickness=0.5));
  connect(die_pin.frame_b, die.frame_a)
    annotation (Line(points={{80, -452}, {84, -452}, {84, -466}, {-8, -466}, {-8, -26}, {0, -26}}, color={95, 95, 95}, thickness=0.5));
  connect(bar.frame_a, lever_pin.frame_a)
    annotation (Line(points={{60, -260}, {48, -260}, {48, -488}, {60, -488}}, color={95, 95, 95}, thickness=0.5));
  connect(lever_pin.frame_b, lever.frame_a)
    annotation (Line(points={{80, -488}, {84, -488}, {84, -502}, {-12, -502}, {-12, -416}, {0, -416}}, color={95, 95, 95}, thickness=0.5));
  connect(block_181fd7.axis, block_181fd7Axis)
    annotation (Line(points={{-34, 10}, {-34, 20}}, color={0, 127, 0}));
  connect(block_181fd7.support, block_181fd7Support)
    annotation (Line(points={{-40, 10}, {-40, 12}, {-48, 12}, {-48, 20}}, color={0, 127, 0}));
  connect(crank.axis, crankAxis)
    annotation (Line(points={{-34, -224}, {-34, -214}}, color={0, 0, 0}));
  connect(crank.support, crankSupport)
    annotation (Line(points={{-40, -224}, {-40, -222}, {-48, -222}, {-48, -214}}, color={0, 0, 0}));
  connect(arm_pin.axis, arm_pinAxis)
    annotation (Line(points={{26, -224}, {26, -214}}, color={0, 0, 0}));
  connect(arm_pin.support, arm_pinSupport)
    annotation (Line(points={{20, -224}, {20, -222}, {12, -222}, {12, -214}}, color={0, 0, 0}));
  connect(ram.axis, ramAxis)
    annotation (Line(points={{-34, -146}, {-34, -136}}, color={0, 127, 0}));
  connect(ram.support, ramSupport)
    annotation (Line(points={{-40, -146}, {-40, -144}, {-48, -144}, {-48, -136}}, color={0, 127, 0}));
  connect(shoe_pin.axis, shoe_pinAxis)
    annotation (Line(points={{26, -146}, {26, -136}}, color={0, 0, 0}));
  connect(shoe_pin.support, shoe_pinSupport)
    annotation (Line(points={{20, -146}, {20, -144}, {12, -144}, {12, -136}}, color={0, 0, 0}));
  connect(rocker.axis, rockerAxis)
    annotation (Line(points={{-34, -380}, {-34, -370}}, color={0, 0, 0}));
  connect(rocker.support, rockerSupport)
    annotation (Line(points={{-40, -380}, {-40, -378}, {-48, -378}, {-48, -370}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 230}}), graphics={
      Rectangle(extent={{-100, 100}, {100, 230}}, lineColor={44, 82, 130}, lineThickness=0.5, radius=14, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid),
      Text(extent={{-90, 106}, {0, 124}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="block_181fd7"),
      Text(extent={{-90, 206}, {0, 224}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="crank"),
      Text(extent={{-90, 146}, {0, 164}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="arm_pin"),
      Text(extent={{-90, 166}, {0, 184}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="ram"),
      Text(extent={{-90, 186}, {0, 204}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="shoe_pin"),
      Text(extent={{-90, 126}, {0, 144}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Left, textString="rocker"),
      Text(extent={{0, 113}, {88, 127}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="die"),
      Text(extent={{0, 173}, {88, 187}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="bar"),
      Text(extent={{0, 193}, {88, 207}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="ring"),
      Text(extent={{0, 133}, {88, 147}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="rod"),
      Text(extent={{0, 153}, {88, 167}}, textColor={64, 64, 64}, horizontalAlignment=TextAlignment.Right, textString="lever")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -506}, {120, 34}})),
    Documentation(info="<html>
<p>
Links and joints of robot Mill, connected. Each can be exchanged in a model that extends this one. Each joint that can be driven has two flanges for its drive: its name with <code>Axis</code> and with <code>Support</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end Mill;
