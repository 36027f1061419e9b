within UrdfSync.Dynamics;

function axisStarts "Where axes start if nobody says otherwise"
  extends Modelica.Icons.Function;

  input Real range[:, 3]
    "One row per axis: {lower, upper, velocity}";

  output Real start[size(range, 1)]
    "Positions, in rad or m";

algorithm
  start := zeros(size(range, 1));
  for i in 1:size(range, 1) loop
    start[i] := UrdfSync.Functions.closestToZero(range[i, 1], range[i, 2]);
  end for;

  annotation (Documentation(info="<html>
<p>
At zero, or at the end of the range that is closest to it (<a href=\"modelica://UrdfSync.Functions.closestToZero\">Functions.closestToZero</a>).
</p>
</html>"));
end axisStarts;
