within UrdfSync.Drives;

partial model PartialTranslationalServo "Drive of a sliding joint that pushes by a law"
  extends UrdfSync.Icons.TranslationalDrive;
  extends Modelica.Mechanics.Translational.Interfaces.PartialElementaryOneFlangeAndSupport2(final useSupport = true);

  parameter UrdfSync.Records.TranslationalServo parameters
    "Gains and limits";

  parameter Modelica.Units.SI.Force f_max = Modelica.Constants.inf
    "Limit of the force, if the drive saturates";

  parameter Modelica.Units.SI.Velocity v_max = Modelica.Constants.inf
    "Limit of the speed, if the drive saturates";

  Modelica.Units.SI.Position s
    "Position of the joint";

  Modelica.Units.SI.Velocity v
    "Speed of the joint";

  Modelica.Units.SI.Force f_asked
    "Force that the law asks for";

  Modelica.Units.SI.Force f
    "Force that the drive gives";

equation
  s = flange.s - s_support;
  v = der(s);
  f = UrdfSync.Functions.limitedEffort(
    UrdfSync.Functions.limited(f_asked, parameters.minEffort, parameters.maxEffort),
    v,
    f_max,
    v_max);
  flange.f = -f;

  annotation (Documentation(info="<html>
<p>
A model that extends this one has the law: it computes <code>f_asked</code> from a command, from <code>s</code> and from <code>v</code>. The drive gives this force
between <code>minEffort</code> and <code>maxEffort</code> of its record. The limits <code>f_max</code> and <code>v_max</code> act as
<a href=\"modelica://UrdfSync.Functions.limitedEffort\">limitedEffort</a> says.
</p>
</html>"));
end PartialTranslationalServo;
