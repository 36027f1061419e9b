within UrdfSync.Records;

record TurningLimits "Limits of all joints that turn"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.Angle lower[:] = fill(0, 0)
    "Smallest positions";

  Modelica.Units.SI.Angle upper[:] = fill(0, 0)
    "Largest positions";

  Modelica.Units.SI.AngularVelocity velocity[:] = fill(0, 0)
    "Largest speeds";

  Modelica.Units.SI.Torque effort[:] = fill(0, 0)
    "Largest drive torques";

  Modelica.Units.SI.AngularAcceleration acceleration[:] = fill(Modelica.Constants.inf, size(velocity, 1))
    "Largest accelerations while joints speed up";

  Modelica.Units.SI.AngularAcceleration deceleration[:] = acceleration
    "The same while they slow down";

  annotation (Documentation(info="<html>
<p>
A table of <a href=\"modelica://UrdfSync.Records.Robot\">Records.Robot</a>: one number per joint, in the order of the joints. Each refers to the <a href=\"modelica://UrdfSync.Records.RotationalLimits\">limits</a> record of its joint. Continuous joints have no smallest and largest position: these are infinite.
</p>
</html>"));
end TurningLimits;
