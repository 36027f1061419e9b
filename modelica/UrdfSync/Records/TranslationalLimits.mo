within UrdfSync.Records;

record TranslationalLimits "Limits of a sliding joint"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.Position lower = -Modelica.Constants.inf
    "Smallest position";

  Modelica.Units.SI.Position upper = Modelica.Constants.inf
    "Largest position";

  Modelica.Units.SI.Velocity velocity = Modelica.Constants.inf
    "Largest speed";

  Modelica.Units.SI.Force effort = Modelica.Constants.inf
    "Largest drive force";

  Modelica.Units.SI.Acceleration acceleration = Modelica.Constants.inf
    "Largest acceleration while the joint speeds up";

  Modelica.Units.SI.Acceleration deceleration = acceleration
    "The same while it slows down";

  Modelica.Units.SI.Jerk jerk = Modelica.Constants.inf
    "Largest rate of change of the acceleration; it is not checked";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;limit&gt;</code> element of URDF. A limit that the URDF does not state is infinite.
</p>
</html>"));
end TranslationalLimits;
