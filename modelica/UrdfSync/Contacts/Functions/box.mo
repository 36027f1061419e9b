within UrdfSync.Contacts.Functions;

function box "Force and torque of the ground on a box"
  extends UrdfSync.Contacts.Functions.PartialForce;

  input Modelica.Units.SI.Length size[3]
    "Edges along the axes of the shape frame";

protected
  Modelica.Units.SI.Position h = height + n*xyz
    "Height of the origin of the shape frame above the ground";

  Real m[3](each unit = "1") = n*R
    "Normal of the ground, resolved in the shape frame";

  Modelica.Units.SI.Position r[3] = zeros(3)
    "Corner, resolved in the shape frame";

  Real wrench[6] = zeros(6)
    "Force and torque";

algorithm
  for x in -1:2:1 loop
    for y in -1:2:1 loop
      for z in -1:2:1 loop
        r := {0.5*x*size[1], 0.5*y*size[2], 0.5*z*size[3]};
        if h + m*r < 0 then
          wrench := wrench
            + UrdfSync.Contacts.Functions.point(height, n, v, w, stiffness, damping, viscosity, friction, slipSpeed, xyz + R*r);
        end if;
      end for;
    end for;
  end for;
  f := wrench[1:3];
  t := wrench[4:6];

  annotation (Documentation(info="<html>
<p>
The eight corners, <code>xyz + R*{±x, ±y, ±z}/2</code> in m: a box on a face stands on four of them.
</p>
</html>"));
end box;
