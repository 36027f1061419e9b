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

  Modelica.Units.SI.Force f_n = stiffness*max(0, -height - n*r)*max(0, 1 - damping*v_n)
    "Normal force, never pulling";

  Modelica.Units.SI.Force f[3] = f_n*(n - friction/sqrt(v_t*v_t + slipSpeed^2)*v_t)
    "Normal force and friction";

algorithm
  wrench := cat(1, f, cross(r, f));

  annotation (Documentation(info="<html>
<p>
A penalty method: at depth <code>p</code> below the ground the normal force is <code>c*p*(1 - d*v_n)</code>, never negative,
with stiffness <code>c</code>, damping <code>d</code> and upward speed <code>v_n</code>. It is the law of Hunt and Crossley
(Coefficient of Restitution Interpreted as Damping in Vibroimpact, Journal of Applied Mechanics 42, 1975) with a linear
spring. The damper grows with the depth, so that the force does not jump when a point touches down or lifts off.
</p>
<p>
Coulomb friction acts against the sliding velocity <code>v_t</code> of the material point, regularised around standstill:
<code>-mu*f_n*v_t/sqrt(v_t*v_t + v_s^2)</code>. Laws of this kind are compared by Pennestrì, Rossi, Salvini and Valentini
(Review and comparison of dry friction force models, Nonlinear Dynamics 83, 2016). There is no stiction: under a tangential
load below the limit of friction the point creeps, slower than the slip speed <code>v_s</code> until 70 % of that limit.
</p>
</html>"));
end point;
