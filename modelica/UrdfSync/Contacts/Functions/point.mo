within UrdfSync.Contacts.Functions;

function point "Force and torque of the ground on one point of a link"
  extends Modelica.Icons.Function;

  input Modelica.Units.SI.Position height
    "Height of the link frame above the ground";

  input Real n[3](each unit = "1")
    "Upward normal of the ground";

  input Modelica.Units.SI.Velocity v[3]
    "Velocity of the origin of the link frame";

  input Modelica.Units.SI.AngularVelocity w[3]
    "Angular velocity of the link";

  input Modelica.Units.SI.TranslationalSpringConstant stiffness
    "Stiffness of the point";

  input Real damping(unit = "s/m")
    "Damping, as part of the spring force";

  input Real viscosity(unit = "N.s/m")
    "Damping of the point beside that, in parallel to its spring";

  input Real friction(unit = "1")
    "Coefficient of friction";

  input Modelica.Units.SI.Velocity slipSpeed
    "Speed at which sliding begins";

  input Modelica.Units.SI.Position r[3]
    "The point";

  output Real wrench[6]
    "Force on the link in N, then torque about the origin of its frame in N.m";

protected
  Modelica.Units.SI.Velocity v_p[3] = v + cross(w, r)
    "Velocity of the material point";

  Modelica.Units.SI.Velocity v_n = n*v_p
    "Its upward part";

  Modelica.Units.SI.Velocity v_t[3] = v_p - v_n*n
    "Its part along the ground";

  Modelica.Units.SI.Length p = max(0, -height - n*r)
    "Depth below the ground";

  Modelica.Units.SI.Force f_n = if p > 0 then max(0, stiffness*p*max(0, 1 - damping*v_n) - viscosity*v_n) else 0
    "Normal force, never pulling";

  Modelica.Units.SI.Force f[3] = f_n*(n - friction/sqrt(v_t*v_t + slipSpeed^2)*v_t)
    "Normal force and friction";

algorithm
  wrench := cat(1, f, cross(r, f));

  annotation (Documentation(info="<html>
<pre>
p   = max(0, -height - n*r)
v_p = v + w x r
f_n = max(0, c*p*max(0, 1 - d*v_n) - k_d*v_n)             where p > 0, else 0
f   = f_n*(n - mu*v_t/sqrt(v_t*v_t + v_s^2))
t   = r x f
</pre>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">
<tr><th align=\"left\">symbol</th><th align=\"left\">input</th><th align=\"left\">unit</th><th align=\"left\">meaning</th></tr>
<tr><td><code>p</code></td><td></td><td>m</td><td>depth of the point below the ground</td></tr>
<tr><td><code>v_p</code>, <code>v_n</code>, <code>v_t</code></td><td></td><td>m/s</td><td>velocity of the material point, its upward part <code>n*v_p</code> and its part along the ground</td></tr>
<tr><td><code>f_n</code>, <code>f</code></td><td></td><td>N</td><td>normal force, and whole force on the link</td></tr>
<tr><td><code>t</code></td><td></td><td>N.m</td><td>torque about the origin of the link frame</td></tr>
<tr><td><code>c</code></td><td><code>stiffness</code></td><td>N/m</td><td>stiffness of the point</td></tr>
<tr><td><code>d</code></td><td><code>damping</code></td><td>s/m</td><td>damping, as part of the spring force</td></tr>
<tr><td><code>k_d</code></td><td><code>viscosity</code></td><td>N.s/m</td><td>damping of a dashpot in parallel to the spring</td></tr>
<tr><td><code>mu</code></td><td><code>friction</code></td><td>1</td><td>coefficient of friction</td></tr>
<tr><td><code>v_s</code></td><td><code>slipSpeed</code></td><td>m/s</td><td>speed at which sliding begins</td></tr>
</table>
<p>
A penalty method. The normal force is the law of Hunt and Crossley
(Coefficient of Restitution Interpreted as Damping in Vibroimpact, Journal of Applied Mechanics 42, 1975) with a linear
spring. The damper grows with the depth, so that the force does not jump when a point touches down or lifts off. The dashpot <code>k_d</code> is the <code>kd</code> of simulators; with
it the force does jump.
</p>
<p>
Coulomb friction acts against the sliding velocity <code>v_t</code> of the material point, regularised around standstill. Laws of this kind are compared by Pennestrì, Rossi, Salvini and Valentini
(Review and comparison of dry friction force models, Nonlinear Dynamics 83, 2016). There is no stiction: under a tangential
load below the limit of friction the point creeps, slower than the slip speed <code>v_s</code> until 70 % of that limit.
</p>
</html>"));
end point;
