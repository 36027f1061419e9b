within UrdfSync.Friction;

model Translational "Viscous damping and smooth dry friction between two translational flanges"
  extends UrdfSync.Friction.PartialTranslational;

equation
  f = parameters.damping*v + parameters.friction*tanh(0.5*parameters.steepness*v);

  annotation (Documentation(info="<html>
<pre>
f = d*v + f_d*tanh(s*v/2)
</pre>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">
<tr><th align=\"left\">symbol</th><th align=\"left\">parameter</th><th align=\"left\">unit</th><th align=\"left\">meaning</th></tr>
<tr><td><code>f</code></td><td></td><td>N</td><td>loss force, against the motion</td></tr>
<tr><td><code>v</code></td><td></td><td>m/s</td><td>speed of <code>flange_b</code> relative to <code>flange_a</code></td></tr>
<tr><td><code>d</code></td><td><code>damping</code></td><td>N.s/m</td><td>viscous damping</td></tr>
<tr><td><code>f_d</code></td><td><code>friction</code></td><td>N</td><td>dry friction</td></tr>
<tr><td><code>s</code></td><td><code>steepness</code></td><td>s/m</td><td>how sharply the dry friction changes its sign around standstill</td></tr>
</table>
<p>
The second term is the law <code>2*f_d/(1 + exp(-s*v)) - f_d</code> of Pignède and Oldemeyer (Modelica Conference 2025), written so
that no speed makes it overflow. It is a smooth form of Coulomb's law (Armstrong-Hélouvry, Dupont, Canudas de Wit: A survey of models, analysis tools and compensation
methods for the control of machines with friction, Automatica 30, 1994). There is no stiction: under load the axis creeps, at
<code>v = (2/s)*artanh(f/f_d)</code> where nothing is damped.
</p>
<p>
The dry friction has 76 % of its value at <code>2/s</code> and 90 % at <code>2.94/s</code>: a sliding joint of default steepness 1000 has 46 % of its dry friction at 1 mm/s, 99.99 % at 10 mm/s.
A greater steepness comes closer to Coulomb's law, and makes the equations stiffer around standstill, where dry friction acts as a damping constant of <code>f_d*s/2</code>.
</p>
</html>"));
end Translational;
