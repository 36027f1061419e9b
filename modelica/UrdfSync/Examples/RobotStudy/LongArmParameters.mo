within UrdfSync.Examples.RobotStudy;

record LongArmParameters "Numbers of the six-axis arm, with a longer forearm and a heavier gripper"
  extends UrdfSync.Examples.SixAxisArm.SixAxisArmParameters(
    forearm_roll(origin(xyz = {0.4, 0, 0.03})),
    gripper_body(inertial(
      origin(xyz = {0, 0, 0.05}),
      mass = 4,
      inertia(ixx = 0.003, iyy = 0.006, izz = 0.006))));

  annotation (Documentation(info="<html>
<p>
Modifiers of a record name links and joints as the robot has them. They reach the tables, since these refer to the components. The numbers of
<code>inertial</code> stand here as a whole, for the sake of rumoca: see <a href=\"modelica://UrdfSync.UsersGuide.RecordApproach\">the limits</a>.
</p>
</html>"));
end LongArmParameters;
