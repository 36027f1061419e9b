within UrdfSync.Friction;

partial model PartialTranslational "What laws of friction between two translational flanges have in common"
  extends UrdfSync.Icons.Friction;
  extends Modelica.Mechanics.Translational.Interfaces.PartialTwoFlanges;

  parameter UrdfSync.Records.JointDynamics.TranslationalDynamics parameters
    "Numbers of the losses";

  Modelica.Units.SI.Position s_rel
    "Position of flange_b relative to flange_a";

  Modelica.Units.SI.Velocity v
    "Speed of flange_b relative to flange_a";

  Modelica.Units.SI.Force f
    "Loss force: it acts against the motion";

equation
  s_rel = flange_b.s - flange_a.s;
  v = der(s_rel);
  flange_b.f = f;
  flange_a.f = -f;

  annotation (Documentation(info="<html>
<p>
A law that extends this class gives <code>f</code>.
</p>
</html>"));
end PartialTranslational;
