within UrdfSync.Drives;

partial model PartialTranslationalServo "Drive of a sliding joint that pushes by a law"
  extends UrdfSync.Icons.TranslationalDrive;

  parameter UrdfSync.Records.TranslationalServo parameters
    "Gains and limits";

  parameter Modelica.Units.SI.Force f_max = Modelica.Constants.inf
    "Limit of the force, if the drive saturates";

  parameter Modelica.Units.SI.Velocity v_max = Modelica.Constants.inf
    "Limit of the speed, if the drive saturates";

  Modelica.Mechanics.Translational.Interfaces.Flange_b flange
    "Axis that is pushed"
    annotation (Placement(transformation(extent={{90, -10}, {110, 10}})));

  Modelica.Mechanics.Translational.Interfaces.Support support
    "Housing of the drive"
    annotation (Placement(transformation(extent={{-10, -110}, {10, -90}})));

  Modelica.Units.SI.Position s
    "Position of the joint";

  Modelica.Units.SI.Velocity v
    "Speed of the joint";

  Modelica.Units.SI.Force f_asked
    "Force that the law asks for";

  Modelica.Units.SI.Force f
    "Force that the drive gives";

equation
  s = flange.s - support.s;
  v = der(s);
  f = UrdfSync.Functions.limitedEffort(
    UrdfSync.Functions.limited(f_asked, parameters.minEffort, parameters.maxEffort),
    v,
    f_max,
    v_max);
  flange.f = -f;
  support.f = f;

  annotation (Documentation(info="<html>
<p>
A model that extends this one has the law: it computes <code>f_asked</code> from a command, from <code>s</code> and from <code>v</code>. The drive gives this force
between <code>minEffort</code> and <code>maxEffort</code> of its record. The limits <code>f_max</code> and <code>v_max</code> act as
<a href=\"modelica://UrdfSync.Functions.limitedEffort\">limitedEffort</a> says.
</p>
</html>"));
end PartialTranslationalServo;
