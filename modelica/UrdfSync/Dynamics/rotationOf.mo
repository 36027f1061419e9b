within UrdfSync.Dynamics;

function rotationOf "Rotation matrix in a row of a table of frames"
  extends Modelica.Icons.Function;

  input Real row[:]
    "Begins with the elements of the matrix, row by row";

  output Real R[3, 3](each unit = "1")
    "The matrix";

algorithm
  R := [row[1], row[2], row[3]; row[4], row[5], row[6]; row[7], row[8], row[9]];

  annotation (Documentation(info="<html>
<p>
The tables of frames hold one frame per row: nine elements of its rotation matrix, its position, and what else there is to say.
</p>
</html>"));
end rotationOf;
