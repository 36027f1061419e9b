within Zoo.Menagerie;

record MenagerieSensors "Numbers of the sensors of robot Menagerie"
  extends UrdfSync.Icons.Parameters;

  UrdfSync.Records.Lidar a_b_c_61f936(
    name = "a\"b\\ <c>",
    updateRate = 10,
    origin(
      xyz = {0, 0, 0.2},
      rpy = {0.1, 0, 0}),
    samples = 720,
    minAngle = -1.5,
    maxAngle = 1.5,
    verticalSamples = 0,
    verticalMinAngle = 0,
    verticalMaxAngle = 0,
    minRange = 0,
    maxRange = 0)
    "Sensor \"a\"b\\ <c>\" of link \"table\"";

  UrdfSync.Records.Lidar door(
    name = "door",
    updateRate = 0,
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    samples = 0,
    minAngle = 0,
    maxAngle = 0,
    verticalSamples = 16,
    verticalMinAngle = -0.25,
    verticalMaxAngle = 0.5,
    minRange = 0.25,
    maxRange = 8)
    "Sensor \"door\" of link \"table\"";

  UrdfSync.Records.Sensor imu(
    name = "imu",
    updateRate = 100,
    origin(
      xyz = {0, 0, 0.1},
      rpy = {0, 0, 1.5}))
    "Sensor \"imu\" of link \"chassis\"";

  UrdfSync.Records.Sensor lift_sensor_8cfdf3(
    name = "lift",
    updateRate = 0,
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}))
    "Sensor \"lift\" of joint \"lift\"";

  UrdfSync.Records.Sensor strain(
    name = "strain",
    updateRate = 0,
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}))
    "Sensor \"strain\" of joint \"shoulder\"";

  UrdfSync.Records.Camera table(
    name = "table",
    updateRate = 0,
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    width = 640,
    height = 480,
    horizontalAngle = 1.2,
    near = 0.1,
    far = 10)
    "Sensor \"table\" of link \"chassis\"";

  UrdfSync.Records.Sensor torque(
    name = "torque",
    updateRate = 0,
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}))
    "Sensor \"torque\" of joint \"elbow\"";

  annotation (Documentation(info="<html>
<p>
Numbers of the sensors of robot Menagerie. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end MenagerieSensors;
