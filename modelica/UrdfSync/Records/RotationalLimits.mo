within UrdfSync.Records;

record RotationalLimits "Limits of a turning joint"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.Angle lower = -Modelica.Constants.inf
    "Smallest position";

  Modelica.Units.SI.Angle upper = Modelica.Constants.inf
    "Largest position";

  Modelica.Units.SI.AngularVelocity velocity = Modelica.Constants.inf
    "Largest speed";

  Modelica.Units.SI.Torque effort = Modelica.Constants.inf
    "Largest drive torque";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;limit&gt;</code> element of URDF. A limit that the URDF does not state is infinite.
</p>
</html>"));
end RotationalLimits;
