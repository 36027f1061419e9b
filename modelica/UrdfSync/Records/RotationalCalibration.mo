within UrdfSync.Records;

record RotationalCalibration "Reference positions of a turning joint"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.Angle rising = Modelica.Constants.inf
    "Where the rising edge is; infinite if not stated";

  Modelica.Units.SI.Angle falling = Modelica.Constants.inf
    "Where the falling edge is; infinite if not stated";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;calibration&gt;</code> element of URDF. Kept for users; no model of this library reads it.
</p>
</html>"));
end RotationalCalibration;
