within UrdfSync.Examples.RobotStudy;

model Wheeled "A robot of another structure"
  extends Modelica.Icons.Example;

  inner Modelica.Mechanics.MultiBody.World world(n = {0, 0, -1})
    "Origin and gravity"
    annotation (Placement(transformation(extent={{-60, -10}, {-40, 10}})));

  UrdfSync.Robots.GenericRobot robot(
    redeclare parameter UrdfSync.Examples.WheeledRobot.WheeledRobotParameters data,
    checkLimits = false)
    "The wheeled robot"
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
Other links, joints and axes. The record is named at the robot, and not by
<code>extends UrdfSync.Examples.GenericRobot(redeclare record Parameters = …)</code>, which rumoca, the compiler behind <code>urdfsync check</code>, refuses where the robot has another
number of joints or links than the one before: see <a href=\"modelica://UrdfSync.UsersGuide.RecordApproach\">the limits</a>.
</p>
</html>"));
end Wheeled;
