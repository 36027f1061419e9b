within UrdfSync;

package Contacts "Ground contact of collision shapes"
  extends Modelica.Icons.Package;

  annotation (Documentation(info="<html>
<p>
A mobile robot stands, rolls and walks on the plane of <code>UrdfSync.Contacts.Ground</code>. Each collision shape of a link
has a contact of its own, which acts at the lowest points of the true geometry: a wheel of radius
<code>r</code> carries its axle at height <code>r</code>.
</p>
<ul>
<li>Declare <code>inner UrdfSync.Contacts.Ground ground(load = ...)</code> once, in the model that is simulated, beside
    <code>inner Modelica.Mechanics.MultiBody.World world(n = {0, 0, -1})</code>.</li>
<li>Connect a <code>Sphere</code>, <code>Ellipsoid</code>, <code>Cylinder</code>, <code>Capsule</code>, <code>Box</code> or <code>Points</code>
    to the <code>frame_a</code> of a link and hand it the record of the collision.</li>
</ul>
<p>
The forces are those of a penalty method, see <a href=\"modelica://UrdfSync.Contacts.Functions.point\">Contacts.Functions.point</a>: at depth <code>p</code>,
</p>
<pre>
f_n = max(0, c*p*max(0, 1 - d*v_n) - k_d*v_n)             N, normal
f_t = -mu*f_n*v_t/sqrt(v_t*v_t + v_s^2)                   N, along the ground
</pre>
<p>
with stiffness <code>c</code>, damping <code>d</code> and <code>k_d</code>, coefficient of friction <code>mu</code> and slip speed <code>v_s</code>. They are those of
the ground, or those that the URDF says of a link (<a href=\"modelica://UrdfSync.Records.Contact\">Records.Contact</a>). Links touch the ground only:
they pass through each other. There is no rolling resistance and no resistance against spinning on one point.
</p>
</html>"));
end Contacts;
