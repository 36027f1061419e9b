within UrdfSync.Friction;

model Rotational "Viscous damping and smooth dry friction between two rotational flanges"
  extends UrdfSync.Icons.Friction;
  extends Modelica.Mechanics.Rotational.Interfaces.PartialTwoFlanges;

  parameter UrdfSync.Records.RotationalDynamics parameters
    "Damping and friction";

  parameter UrdfSync.Types.RotationalSteepness steepness = 100
    "How sharply the dry friction changes its sign around standstill";

  Modelica.Units.SI.Angle phi_rel
    "Position of flange_b relative to flange_a";

  Modelica.Units.SI.AngularVelocity w
    "Speed of flange_b relative to flange_a";

  Modelica.Units.SI.Torque tau
    "Loss torque: it acts against the motion";

equation
  phi_rel = flange_b.phi - flange_a.phi;
  w = der(phi_rel);
  tau = parameters.damping*w + parameters.friction*tanh(0.5*steepness*w);
  flange_b.tau = tau;
  flange_a.tau = -tau;

  annotation (Documentation(info="<html>
<p>
<code>tau = d*w + f*tanh(s*w/2)</code> with damping <code>d</code>, dry friction <code>f</code> and steepness <code>s</code>.
The second term is the law <code>2*f/(1 + exp(-s*w)) - f</code> of Pignède and Oldemeyer (Modelica Conference 2025), written so
that no speed makes it overflow. There is no stiction: under load the axis creeps.
</p>
</html>"));
end Rotational;
