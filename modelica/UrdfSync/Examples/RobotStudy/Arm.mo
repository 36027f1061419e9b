within UrdfSync.Examples.RobotStudy;

model Arm "The six-axis arm as it is"
  extends UrdfSync.Examples.GenericRobot(
    redeclare record Parameters = UrdfSync.Examples.SixAxisArm.SixAxisArmParameters);

  annotation (
    experiment(StopTime=0.5, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
The record that the package of the robot holds.
</p>
</html>"));
end Arm;
