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
The steepness <code>s</code> is no number of URDF. It stands in the record of each joint: <code>elbow(parameters(dynamics(steepness = 300)))</code>.
</p>
</html>"));
end Friction;
