within UrdfSync.Contacts.Functions;

function points "Force and torque of the ground on a set of points"
  extends UrdfSync.Contacts.Functions.PartialForce;

  input Modelica.Units.SI.Position corners[:, 3]
    "One point per row, resolved in the shape frame";

protected
  Modelica.Units.SI.Position h = height + n*xyz
    "Height of the origin of the shape frame above the ground";

  Real m[3](each unit = "1") = n*R
    "Normal of the ground, resolved in the shape frame";

  Real wrench[6] = zeros(6)
    "Force and torque";

algorithm
  for i in 1:size(corners, 1) loop
    if h + m*corners[i, :] < 0 then
      wrench := wrench
        + UrdfSync.Contacts.Functions.point(height, n, v, w, stiffness, damping, viscosity, friction, slipSpeed, xyz + R*corners[i, :]);
    end if;
  end for;
  f := wrench[1:3];
  t := wrench[4:6];

  annotation (Documentation(info="<html>
<p>
The corners of the convex hull of a mesh: no other point of it can be its lowest.
</p>
</html>"));
end points;
