within UrdfSync.Examples.RobotStudy;

model LongArm "The arm with a longer forearm and a heavier gripper"
  extends UrdfSync.Examples.GenericRobot(
    redeclare record Parameters = UrdfSync.Examples.RobotStudy.LongArmParameters);

  annotation (
    experiment(StopTime=0.5, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
The same structure, other numbers.
</p>
</html>"));
end LongArm;
