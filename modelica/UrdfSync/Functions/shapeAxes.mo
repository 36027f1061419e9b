within UrdfSync.Functions;

function shapeAxes "Axes of shape frames, one per shape"
  extends Modelica.Icons.Function;

  input Modelica.Units.SI.Angle angles[:, 3]
    "Per shape: roll, pitch and yaw of its frame in the link frame";

  input Integer axes[size(angles, 1)]
    "Per shape: 1 for the x axis of its frame, 2 for y, 3 for z";

  output Real e[size(angles, 1), 3](each unit = "1")
    "Per shape: unit vector along that axis, resolved in the link frame";

protected
  Real R[3, 3];
algorithm
  e := zeros(size(angles, 1), 3);
  R := identity(3);
  for k in 1:size(angles, 1) loop
    R := UrdfSync.Functions.rotation(angles[k, :]);
    e[k, :] := R[:, axes[k]];
  end for;

  annotation (Documentation(info="<html>
<p>
The shapes of the Modelica Standard Library have directions of length and width. In a URDF, a box or a file has its length along x, a cylinder along z;
the width is along y.
</p>
</html>"));
end shapeAxes;
