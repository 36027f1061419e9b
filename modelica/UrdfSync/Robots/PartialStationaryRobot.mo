within UrdfSync.Robots;

partial model PartialStationaryRobot "Robot that is bolted to its surroundings"
  extends UrdfSync.Icons.StationaryRobot;
  extends UrdfSync.Robots.PartialRobot;

  annotation (Documentation(info="<html>
<p>
The root link is to be connected to the world or to what carries the robot.
</p>
</html>"));
end PartialStationaryRobot;
