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

  Modelica.Units.SI.AngularAcceleration acceleration = Modelica.Constants.inf
    "Largest acceleration while the joint speeds up";

  Modelica.Units.SI.AngularAcceleration deceleration = acceleration
    "The same while it slows down";

  Modelica.Units.SI.AngularJerk jerk = Modelica.Constants.inf
    "Largest rate of change of the acceleration; it is not checked";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;limit&gt;</code> element of URDF. A limit that the URDF does not state is infinite.
</p>
</html>"));
end RotationalLimits;
