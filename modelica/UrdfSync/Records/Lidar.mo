within UrdfSync.Records;

record Lidar "Numbers of a laser scanner"
  extends UrdfSync.Records.Sensor;

  Integer samples(min = 0) = 0
    "Rays per turn";

  Modelica.Units.SI.Angle minAngle = 0
    "Angle of the first ray";

  Modelica.Units.SI.Angle maxAngle = 0
    "Angle of the last ray";

  Integer verticalSamples(min = 0) = 0
    "Layers";

  Modelica.Units.SI.Angle verticalMinAngle = 0
    "Angle of the lowest layer";

  Modelica.Units.SI.Angle verticalMaxAngle = 0
    "Angle of the highest layer";

  Modelica.Units.SI.Distance minRange = 0
    "Nearest distance that is measured";

  Modelica.Units.SI.Distance maxRange = 0
    "Farthest distance that is measured";

  annotation (Documentation(info="<html>
<p>
A laser scanner of one layer or several. What the URDF does not say is 0.
</p>
</html>"));
end Lidar;
