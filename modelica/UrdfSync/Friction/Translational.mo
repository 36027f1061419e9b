within UrdfSync.Friction;

model Translational "Viscous damping and smooth dry friction between two translational flanges"
  extends UrdfSync.Icons.Friction;
  extends Modelica.Mechanics.Translational.Interfaces.PartialTwoFlanges;

  parameter UrdfSync.Records.TranslationalDynamics parameters
    "Damping and friction";

  parameter UrdfSync.Types.TranslationalSteepness steepness = 100
    "How sharply the dry friction changes its sign around standstill";

  Modelica.Units.SI.Position s_rel
    "Position of flange_b relative to flange_a";

  Modelica.Units.SI.Velocity v
    "Speed of flange_b relative to flange_a";

  Modelica.Units.SI.Force f
    "Loss force: it acts against the motion";

equation
  s_rel = flange_b.s - flange_a.s;
  v = der(s_rel);
  f = parameters.damping*v + parameters.friction*tanh(0.5*steepness*v);
  flange_b.f = f;
  flange_a.f = -f;

  annotation (Documentation(info="<html>
<p>
<code>f = d*v + f*tanh(s*v/2)</code> with damping <code>d</code>, dry friction <code>f</code> and steepness <code>s</code>.
The second term is the law <code>2*f/(1 + exp(-s*v)) - f</code> of Pignède and Oldemeyer (Modelica Conference 2025), written so
that no speed makes it overflow. There is no stiction: under load the axis creeps.
</p>
</html>"));
end Translational;
