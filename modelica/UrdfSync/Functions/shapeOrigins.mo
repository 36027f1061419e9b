within UrdfSync.Functions;

function shapeOrigins "Points at which shapes begin"
  extends Modelica.Icons.Function;

  input Modelica.Units.SI.Position positions[:, 3]
    "Per shape: origin of its frame in the link frame";

  input Modelica.Units.SI.Position starts[size(positions, 1)]
    "Per shape: where it begins on its length axis, from there";

  input Real e[size(positions, 1), 3](each unit = "1")
    "Per shape: direction of its length";

  output Modelica.Units.SI.Position r_shape[size(positions, 1), 3]
    "Per shape: where it begins, resolved in the link frame";

algorithm
  r_shape := zeros(size(positions, 1), 3);
  for k in 1:size(positions, 1) loop
    r_shape[k, :] := positions[k, :] + starts[k]*e[k, :];
  end for;

  annotation (Documentation(info="<html>
<p>
A URDF places the middle of a box, cylinder or sphere, the Modelica Standard Library one end of it.
</p>
</html>"));
end shapeOrigins;
