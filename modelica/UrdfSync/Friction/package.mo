within UrdfSync;

package Friction "Losses of joints"
  extends Modelica.Icons.Package;

  annotation (Documentation(info="<html>
<p>
Viscous damping and dry friction between the two sides of an axis, with the numbers of URDF's
<code>&lt;dynamics&gt;</code> element:
</p>
<pre>
tau = d*w + tau_d*tanh(s*w/2)     joints that turn: N.m, rad/s
f   = d*v + f_d*tanh(s*v/2)       joints that slide: N, m/s
</pre>
<p>
This law is smooth: under load a joint creeps. Two others hold: <a href=\"modelica://UrdfSync.Friction.RotationalStiction\">stiction</a>, which is exact and has events, and
<a href=\"modelica://UrdfSync.Friction.RotationalLuGre\">LuGre</a>, which has a stiff state instead. The option <code>friction</code> of a robot chooses, and so does
<code>redeclare model FrictionLaw = UrdfSync.Friction.RotationalLuGre</code> in a joint.
</p>
<p>
All numbers but damping and dry friction are no numbers of URDF. They stand in the record of each joint: <code>elbow(parameters(dynamics(steepness = 300)))</code>.
</p>
</html>"));
end Friction;
