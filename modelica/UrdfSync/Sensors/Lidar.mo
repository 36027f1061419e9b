within UrdfSync.Sensors;

model Lidar "Frame of a laser scanner, with its numbers"
  extends Modelica.Icons.RoundSensor;
  extends UrdfSync.Sensors.PartialSensor(place = parameters.origin);

  parameter UrdfSync.Records.Lidar parameters
    "Numbers of the sensor"
    annotation (Placement(transformation(extent={{-100, 80}, {-80, 100}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_b frame_b
    "Frame of the sensor"
    annotation (Placement(transformation(extent={{84, -16}, {116, 16}})));

equation
  connect(origin.frame_b, frame_b)
    annotation (Line(points={{-50, 0}, {100, 0}}, color={95, 95, 95}, thickness=0.5));

  annotation (Documentation(info="<html>
<p>
It shows no image: models that do so are connected to <code>frame_b</code>, and read <code>parameters</code>. Angles are counted from x of its frame, about z, and upwards about -y.
</p>
</html>"));
end Lidar;
