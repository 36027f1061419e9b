within UrdfSync.Contacts.Functions;

function capsule "Force and torque of the ground on a capsule"
  extends UrdfSync.Contacts.Functions.PartialForce;

  input Modelica.Units.SI.Radius radius
    "Radius of cylinder and half spheres";

  input Modelica.Units.SI.Length length
    "Length of the cylinder, without the half spheres";

protected
  Modelica.Units.SI.Position axial[3] = 0.5*length*R[:, 3]
    "From the centre of the capsule to the centre of a half sphere";

  Modelica.Units.SI.Position down[3] = -radius*n
    "From there to the lowest point of the half sphere";

  Real wrench[6] =
    UrdfSync.Contacts.Functions.point(height, n, v, w, stiffness, damping, viscosity, friction, slipSpeed, xyz + axial + down)
    + UrdfSync.Contacts.Functions.point(height, n, v, w, stiffness, damping, viscosity, friction, slipSpeed, xyz - axial + down)
    "Force and torque";

algorithm
  f := wrench[1:3];
  t := wrench[4:6];

  annotation (Documentation(info="<html>
<p>
The lowest points of the two half spheres, <code>xyz ± length/2*e - radius*n</code> in m, with the unit vectors <code>e</code> along the axis and <code>n</code> upward. A capsule on its side rests on both, an upright one on one of them.
</p>
</html>"));
end capsule;
