within UrdfSync.Examples;

model RobotStudy "One experiment with three robots"
  extends Modelica.Icons.Example;

  inner Modelica.Mechanics.MultiBody.World world(n = {0, 0, -1})
    "Origin and gravity"
    annotation (Placement(transformation(extent={{-60, -10}, {-40, 10}})));

  UrdfSync.Robots.GenericRobot arm(
    redeclare parameter UrdfSync.Examples.SixAxisArm.SixAxisArmParameters data,
    checkLimits = false)
    "The arm as it is"
    annotation (Placement(transformation(extent={{20, 40}, {60, 80}})));

  UrdfSync.Robots.GenericRobot longArm(
    redeclare parameter UrdfSync.Examples.SixAxisArm.SixAxisArmParameters data(
      forearm_roll(origin(xyz = {0.4, 0, 0.03})),
      gripper_body(inertial(mass = 4))),
    checkLimits = false)
    "The arm with a longer forearm and a heavier gripper"
    annotation (Placement(transformation(extent={{20, -20}, {60, 20}})));

  UrdfSync.Robots.GenericRobot wheeled(
    redeclare parameter UrdfSync.Examples.WheeledRobot.WheeledRobotParameters data,
    checkLimits = false)
    "A robot of another structure"
    annotation (Placement(transformation(extent={{20, -80}, {60, -40}})));

  parameter Integer armTool = UrdfSync.Dynamics.toolLink(arm.data.jointTree, arm.data.linkBodies)
    "Number of its link to look at";

  parameter Integer longArmTool = UrdfSync.Dynamics.toolLink(longArm.data.jointTree, longArm.data.linkBodies)
    "Number of its link to look at";

  parameter Integer wheeledTool = UrdfSync.Dynamics.toolLink(wheeled.data.jointTree, wheeled.data.linkBodies)
    "Number of its link to look at";

  Modelica.Units.SI.Position r_tool[3, 3]
    "One row per robot: where the frame of this link is, resolved in the world frame";

equation
  connect(world.frame_b, arm.frame_a)
    annotation (Line(points={{-40, 0}, {-10, 0}, {-10, 60}, {20, 60}}, color={95, 95, 95}, thickness=0.5));
  connect(world.frame_b, longArm.frame_a)
    annotation (Line(points={{-40, 0}, {20, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(world.frame_b, wheeled.frame_a)
    annotation (Line(points={{-40, 0}, {-10, 0}, {-10, -60}, {20, -60}}, color={95, 95, 95}, thickness=0.5));
  for i in 1:3 loop
    r_tool[1, i] = arm.r_0[armTool, i];
    r_tool[2, i] = longArm.r_0[longArmTool, i];
    r_tool[3, i] = wheeled.r_0[wheeledTool, i];
  end for;

  annotation (
    experiment(StopTime=0.5, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
The model of <a href=\"modelica://UrdfSync.Robots.GenericRobot\">GenericRobot</a> three times: with a record, with other numbers in it, and with the
record of another robot. Modifiers of a record name links and joints as the robot has them, and reach the tables, since these refer to them. All three
drop from where they start, without drives, on a fixed base.
</p>
</html>"));
end RobotStudy;
