within UrdfSync.Examples.WheeledRobot;

record WheeledRobotSensors "Numbers of the sensors of robot WheeledRobot"
  extends UrdfSync.Icons.Parameters;

  UrdfSync.Records.Lidar lidar_sensor_5be26f(
    name = "lidar",
    updateRate = 10,
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    samples = 0,
    minAngle = 0,
    maxAngle = 0,
    verticalSamples = 0,
    verticalMinAngle = 0,
    verticalMaxAngle = 0,
    minRange = 0,
    maxRange = 0)
    "Sensor \"lidar\" of link \"lidar\"";

  annotation (Documentation(info="<html>
<p>
Numbers of the sensors of robot WheeledRobot. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "18d63be1-b0a5", base = "dc7eb14afe9dd435"));
end WheeledRobotSensors;
