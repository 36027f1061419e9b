within UrdfSync.Records;

record SlidingLimits "Limits of all joints that slide"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.Position lower[:] = fill(0, 0)
    "Smallest positions";

  Modelica.Units.SI.Position upper[:] = fill(0, 0)
    "Largest positions";

  Modelica.Units.SI.Velocity velocity[:] = fill(0, 0)
    "Largest speeds";

  Modelica.Units.SI.Force effort[:] = fill(0, 0)
    "Largest drive forces";

  Modelica.Units.SI.Acceleration acceleration[:] = fill(Modelica.Constants.inf, size(velocity, 1))
    "Largest accelerations while joints speed up";

  Modelica.Units.SI.Acceleration deceleration[:] = acceleration
    "The same while they slow down";

  annotation (Documentation(info="<html>
<p>
A table of <a href=\"modelica://UrdfSync.Records.Robot\">Records.Robot</a>: one number per joint, in the order of the joints. Each refers to the <a href=\"modelica://UrdfSync.Records.TranslationalLimits\">limits</a> record of its joint.
</p>
</html>"));
end SlidingLimits;
