within UrdfSync.Sensors;

model Imu "Accelerometer and gyroscope, three axes each"
  extends Modelica.Icons.RoundSensor;
  extends UrdfSync.Sensors.PartialSensor(place = parameters.origin);

  parameter UrdfSync.Records.Sensor parameters
    "Numbers of the sensor"
    annotation (Placement(transformation(extent={{-100, 80}, {-80, 100}})));

  Modelica.Blocks.Interfaces.RealOutput a[3](each unit = "m/s2")
    "Acceleration minus gravity, in the axes of the sensor: upwards 9.81 at rest"
    annotation (Placement(transformation(extent={{100, 30}, {120, 50}})));

  Modelica.Blocks.Interfaces.RealOutput w[3](each unit = "rad/s")
    "Angular velocity, in the axes of the sensor"
    annotation (Placement(transformation(extent={{100, -50}, {120, -30}})));

  Modelica.Mechanics.MultiBody.Sensors.AbsoluteSensor motion(
    animation = false,
    resolveInFrame = Modelica.Mechanics.MultiBody.Types.ResolveInFrameA.frame_a,
    get_a = true,
    get_w = true)
    "Acceleration and angular velocity in the world"
    annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));

protected
  outer Modelica.Mechanics.MultiBody.World world
    "Gravity";

  Modelica.Blocks.Interfaces.RealOutput acceleration[3](each unit = "m/s2")
    "Acceleration in the world, in the axes of the sensor"
    annotation (Placement(transformation(extent={{30, -30}, {50, -10}})));

equation
  a = acceleration - Modelica.Mechanics.MultiBody.Frames.resolve2(origin.frame_b.R, world.gravityAcceleration(origin.frame_b.r_0));
  connect(origin.frame_b, motion.frame_a)
    annotation (Line(points={{-50, 0}, {-10, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(motion.a, acceleration)
    annotation (Line(points={{-2, -11}, {-2, -20}, {40, -20}}, color={0, 0, 127}));
  connect(motion.w, w)
    annotation (Line(points={{6, -11}, {6, -40}, {110, -40}}, color={0, 0, 127}));

  annotation (Documentation(info="<html>
<p>
The fields <code>linear_acceleration</code> and <code>angular_velocity</code> of <code>sensor_msgs/Imu</code>. As in ROS, an accelerometer does not feel gravity but
what holds it against gravity: with z upwards it shows +9.81 m/s2 on z at rest, and zero in free fall.
</p>
</html>"));
end Imu;
