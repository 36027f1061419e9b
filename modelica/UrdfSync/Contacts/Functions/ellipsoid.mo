within UrdfSync.Contacts.Functions;

function ellipsoid "Force and torque of the ground on an ellipsoid"
  extends UrdfSync.Contacts.Functions.PartialForce;

  input Modelica.Units.SI.Radius radii[3]
    "Half axes along the axes of the shape frame";

protected
  Real m[3](each unit = "1") = n*R
    "Normal of the ground, resolved in the shape frame";

  Modelica.Units.SI.Length d[3] = {radii[1]*m[1], radii[2]*m[2], radii[3]*m[3]}
    "Its length is the height of the centre above the lowest point";

  Modelica.Units.SI.Position down[3] = -R*{radii[1]*d[1], radii[2]*d[2], radii[3]*d[3]}/max(sqrt(d*d), Modelica.Constants.small)
    "From the centre to the lowest point; zero for a flat ellipsoid that lies on the ground";

  Real wrench[6] =
    UrdfSync.Contacts.Functions.point(height, n, v, w, stiffness, damping, viscosity, friction, slipSpeed, xyz + down)
    "Force and torque";

algorithm
  f := wrench[1:3];
  t := wrench[4:6];

  annotation (Documentation(info="<html>
<pre>
down = -A*A*m/sqrt(m*A*A*m),   A = diagonal(radii)
</pre>
<p>
is the way in m from the centre to the lowest point, resolved in the shape frame, with the upward normal <code>m</code>, a unit vector. The point moves
over the surface as the ellipsoid rolls; its sliding velocity is that of the material point.
</p>
</html>"));
end ellipsoid;
