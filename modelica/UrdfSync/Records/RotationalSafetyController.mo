within UrdfSync.Records;

record RotationalSafetyController "Soft limits of a turning joint"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.RotationalDampingConstant k_velocity = 0
    "Gain from speed error to effort bound";

  UrdfSync.Types.PositionGain k_position = 0
    "Gain from position error to speed bound";

  Modelica.Units.SI.Angle soft_lower_limit = -Modelica.Constants.inf
    "Smallest position that the controller allows";

  Modelica.Units.SI.Angle soft_upper_limit = Modelica.Constants.inf
    "Largest position that the controller allows";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;safety_controller&gt;</code> element of URDF. Kept for users; no model of this library reads it.
</p>
</html>"));
end RotationalSafetyController;
