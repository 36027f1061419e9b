within UrdfSync.Records;

record TranslationalSafetyController "Soft limits of a sliding joint"
  extends UrdfSync.Icons.Parameters;

  Real k_velocity(unit = "N.s/m") = 0
    "Gain from speed error to effort bound";

  Real k_position(unit = "1/s") = 0
    "Gain from position error to speed bound";

  Modelica.Units.SI.Position soft_lower_limit = -Modelica.Constants.inf
    "Smallest position that the controller allows";

  Modelica.Units.SI.Position soft_upper_limit = Modelica.Constants.inf
    "Largest position that the controller allows";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;safety_controller&gt;</code> element of URDF. Kept for users; no model of this library reads it.
</p>
</html>"));
end TranslationalSafetyController;
