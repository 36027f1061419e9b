within UrdfSync.Examples.RobotStudy;

model Wheeled "A robot of another structure"
  extends UrdfSync.Examples.GenericRobot(
    redeclare record Parameters = UrdfSync.Examples.WheeledRobot.WheeledRobotParameters,
    robot(data(rotationalAxes = 7, translationalAxes = 1)));

  annotation (
    experiment(StopTime=0.5, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
Other links, joints and axes. The modifiers of <code>robot</code> repeat what the record says, for rumoca: see
<a href=\"modelica://UrdfSync.UsersGuide.RecordApproach\">the limits</a>. Other tools do without them.
</p>
</html>"));
end Wheeled;
