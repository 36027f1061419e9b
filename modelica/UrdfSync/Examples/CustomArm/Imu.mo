within UrdfSync.Examples.CustomArm;

model Imu "Inertial sensor: accelerometer and gyroscope, three axes each"
  extends Modelica.Icons.RoundSensor;

  parameter Modelica.Units.SI.Position r[3] = {0, 0, 0}
    "Place of the sensor in the link's frame";

  parameter Boolean animation = true
    "= true, if the sensor is drawn"
    annotation (Dialog(tab="Animation"));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a
    "Frame of the link that carries the sensor"
    annotation (Placement(transformation(extent={{-116, -16}, {-84, 16}})));

  Modelica.Blocks.Interfaces.RealOutput f[3](each unit = "m/s2")
    "What the accelerometer shows: acceleration without gravity, in axes of the link"
    annotation (Placement(transformation(extent={{100, 30}, {120, 50}})));

  Modelica.Blocks.Interfaces.RealOutput w[3](each unit = "rad/s")
    "What the gyroscope shows: angular velocity, in axes of the link"
    annotation (Placement(transformation(extent={{100, -50}, {120, -30}})));

  Modelica.Mechanics.MultiBody.Parts.FixedTranslation mount(
    animation = false,
    r = r)
    "From the link's frame to the sensor"
    annotation (Placement(transformation(extent={{-70, -10}, {-50, 10}})));

  Modelica.Mechanics.MultiBody.Sensors.AbsoluteSensor sensor(
    animation = false,
    resolveInFrame = Modelica.Mechanics.MultiBody.Types.ResolveInFrameA.frame_a,
    get_a = true,
    get_w = true)
    "Acceleration and angular velocity in the world"
    annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));

  Modelica.Mechanics.MultiBody.Visualizers.FixedShape box(
    animation = animation,
    length = 0.04,
    width = 0.03,
    height = 0.015,
    r_shape = {-0.02, 0, 0},
    color = {60, 140, 90})
    "Housing of the sensor"
    annotation (Placement(transformation(extent={{-10, 50}, {10, 70}})));

protected
  outer Modelica.Mechanics.MultiBody.World world
    "Gravity";

  Modelica.Blocks.Interfaces.RealOutput a[3](each unit = "m/s2")
    "Acceleration in the world, in axes of the link"
    annotation (Placement(transformation(extent={{30, -30}, {50, -10}})));

equation
  f = a - Modelica.Mechanics.MultiBody.Frames.resolve2(mount.frame_b.R, world.gravityAcceleration(mount.frame_b.r_0));
  connect(frame_a, mount.frame_a)
    annotation (Line(points={{-100, 0}, {-70, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(mount.frame_b, sensor.frame_a)
    annotation (Line(points={{-50, 0}, {-10, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(mount.frame_b, box.frame_a)
    annotation (Line(points={{-50, 0}, {-30, 0}, {-30, 60}, {-10, 60}}, color={95, 95, 95}, thickness=0.5));
  connect(sensor.a, a)
    annotation (Line(points={{-2, -11}, {-2, -20}, {40, -20}}, color={0, 0, 127}));
  connect(sensor.w, w)
    annotation (Line(points={{6, -11}, {6, -40}, {110, -40}}, color={0, 0, 127}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-150, 80}, {150, 120}}, textColor={0, 0, 255}, textString="%name"),
      Line(points={{-70, 0}, {-100, 0}}, color={95, 95, 95}),
      Line(points={{70, 0}, {84, 0}, {84, 40}, {100, 40}}, color={0, 0, 127}),
      Line(points={{84, 0}, {84, -40}, {100, -40}}, color={0, 0, 127}),
      Text(extent={{88, 44}, {132, 74}}, textColor={64, 64, 64}, textString="f"),
      Text(extent={{88, -36}, {132, -6}}, textColor={64, 64, 64}, textString="w")}),
    Documentation(info="<html>
<p>
An accelerometer does not feel gravity but what holds it against gravity: at rest it shows 9.81 m/s2 upwards, in free fall zero.
</p>
</html>"));
end Imu;
