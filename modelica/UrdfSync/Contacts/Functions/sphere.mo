within UrdfSync.Contacts.Functions;

function sphere "Force and torque of the ground on a sphere"
  extends UrdfSync.Contacts.Functions.PartialForce;

  input Modelica.Units.SI.Radius radius
    "Radius";

protected
  Real wrench[6] =
    UrdfSync.Contacts.Functions.point(height, n, v, w, stiffness, damping, viscosity, friction, slipSpeed, xyz - radius*n)
    "Force and torque";

algorithm
  f := wrench[1:3];
  t := wrench[4:6];

  annotation (Documentation(info="<html>
<p>
A sphere has one lowest point, straight below its centre: <code>xyz - radius*n</code>, in m.
</p>
</html>"));
end sphere;
