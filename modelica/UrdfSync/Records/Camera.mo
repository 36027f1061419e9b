within UrdfSync.Records;

record Camera "Numbers of a camera"
  extends UrdfSync.Records.Sensor;

  Integer width(min = 0) = 0
    "Columns of the image";

  Integer height(min = 0) = 0
    "Rows of the image";

  Modelica.Units.SI.Angle horizontalAngle = 0
    "Horizontal field of view";

  Modelica.Units.SI.Distance near = 0
    "Nearest distance that is seen";

  Modelica.Units.SI.Distance far = 0
    "Farthest distance that is seen";

  annotation (Documentation(info="<html>
<p>
A camera, or one for depths. What the URDF does not say is 0.
</p>
</html>"));
end Camera;
