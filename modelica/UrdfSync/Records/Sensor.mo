within UrdfSync.Records;

record Sensor "Numbers of a sensor"
  extends UrdfSync.Icons.Parameters;

  String name = ""
    "Name in the URDF";

  Modelica.Units.SI.Frequency updateRate = 0
    "Measurements per second; 0 if the URDF says nothing";

  Origin origin
    "Place of the sensor in the frame of its link";

  annotation (Documentation(info="<html>
<p>
The numbers that all kinds of sensors have. The rate is for models that sample: the sensors of the library measure at any time.
</p>
</html>"));
end Sensor;
