within UrdfSync.Examples;

model GenericRobot "A bench whose robot is chosen by its record"
  extends Modelica.Icons.Example;

  replaceable record Parameters = UrdfSync.Examples.SixAxisArm.SixAxisArmParameters
    "The robot: redeclare it to have another one"
    constrainedby UrdfSync.Records.Robot
    annotation (choicesAllMatching=true);

  inner Modelica.Mechanics.MultiBody.World world(n = {0, 0, -1})
    "Origin and gravity"
    annotation (Placement(transformation(extent={{-60, -10}, {-40, 10}})));

  UrdfSync.Robots.GenericRobot robot(
    redeclare parameter Parameters data,
    checkLimits = false)
    "Whatever robot the record describes"
    annotation (Placement(transformation(extent={{0, -20}, {40, 20}})));

  parameter Integer tool = UrdfSync.Dynamics.toolLink(robot.data.jointTree, robot.data.linkBodies)
    "Number of the link to look at";

  Modelica.Units.SI.Position r_tool[3]
    "Where its frame is, resolved in the world frame";

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-40, 0}, {0, 0}}, color={95, 95, 95}, thickness=0.5));
  for i in 1:3 loop
    r_tool[i] = robot.r_0[tool, i];
  end for;

  annotation (
    experiment(StopTime=0.5, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
Drives are off: the robot drops from where it starts, braked by its losses. Nothing in the bench says which robot it is but the record. Another robot is
another record:
</p>
<pre>
model WheeledBench = UrdfSync.Examples.GenericRobot(
  redeclare record Parameters = UrdfSync.Examples.WheeledRobot.WheeledRobotParameters);
</pre>
<p>
rumoca, the compiler behind <code>urdfsync check</code>, takes that only for robots with the same numbers of links, joints and axes: see
<a href=\"modelica://UrdfSync.UsersGuide.RecordApproach\">the limits</a>. <a href=\"modelica://UrdfSync.Examples.RobotStudy\">RobotStudy</a>
has three robots.
</p>
</html>"));
end GenericRobot;
