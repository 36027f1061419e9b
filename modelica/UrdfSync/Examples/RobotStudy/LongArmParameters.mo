within UrdfSync.Examples.RobotStudy;

record LongArmParameters "Numbers of the six-axis arm, with a longer forearm and a heavier gripper"
  extends UrdfSync.Examples.SixAxisArm.SixAxisArmParameters(
    forearm_roll(origin(xyz = {0.4, 0, 0.03})),
    gripper_body(inertial(mass = 4)));

  annotation (Documentation(info="<html>
<p>
Modifiers of a record name links and joints as the robot has them. They reach the tables, since these refer to the components.
</p>
</html>"));
end LongArmParameters;
