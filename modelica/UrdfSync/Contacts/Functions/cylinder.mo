within UrdfSync.Contacts.Functions;

function cylinder "Force and torque of the ground on a cylinder"
  extends UrdfSync.Contacts.Functions.PartialForce;

  input Modelica.Units.SI.Radius radius
    "Radius";

  input Modelica.Units.SI.Length length
    "Length along the z axis of the shape frame";

protected
  constant Real upright = 1e-3
    "Sine of the tilt, below which a cylinder counts as upright";

  constant Real tilted = 0.15
    "Sine of the tilt, from which the lowest points alone carry";

  Real c(unit = "1") = n*R[:, 3]
    "Cosine of the angle between axis and normal";

  Real s2(unit = "1") = max(0, 1 - c^2)
    "Square of the sine of that angle";

  Modelica.Units.SI.Position down[3] = radius/sqrt(s2 + upright^2)*(c*R[:, 3] - n)
    "From the centre of a rim to its lowest point; to its centre while the cylinder is upright";

  Modelica.Units.SI.Position axial[3] = (if c > 0 then -0.5 else 0.5)*length*R[:, 3]
    "From the centre of the cylinder to its lower end";

  Real share(unit = "1") = max(0, 1 - s2/tilted^2)
    "Weight of the supports around the lower rim";

  Real wrench[6] =
    UrdfSync.Contacts.Functions.point(height, n, v, w, stiffness, damping, viscosity, friction, slipSpeed, xyz + axial + down)
    + UrdfSync.Contacts.Functions.point(height, n, v, w, stiffness, damping, viscosity, friction, slipSpeed, xyz - axial + down)
    "Force and torque";

  Modelica.Units.SI.Position r[3] = zeros(3)
    "Support at the lower rim";

algorithm
  if share > 0 then
    for i in 1:2 loop
      for side in -1:2:1 loop
        r := xyz + axial + side*radius*R[:, i];
        wrench := wrench
          + share*UrdfSync.Contacts.Functions.point(height, n, v, w, stiffness, damping, viscosity, friction, slipSpeed, r);
      end for;
    end for;
  end if;
  f := wrench[1:3];
  t := wrench[4:6];

  annotation (Documentation(info="<html>
<pre>
down = r*(c*e - n)/sqrt(s2 + upright^2),   c = n*e,   s2 = 1 - c^2
</pre>
<p>
is the way in m from the centre of a rim to its lowest point, with the radius <code>r</code>, the axis <code>e</code> and the upward normal <code>n</code>, unit vectors.
</p>
<p>
The lowest point of each rim, which moves around the rim as the cylinder rolls: a wheel runs without bumps. Its sliding
velocity is that of the material point, zero while the wheel rolls. An upright cylinder has no single lowest point: its point
goes smoothly to the centre of the lower end within a tilt of about 0.001 rad, and four more points of the lower rim, fixed to
the link, take over. They fade out until a tilt of 8.6 degrees, and a wheel never feels them.
</p>
</html>"));
end cylinder;
