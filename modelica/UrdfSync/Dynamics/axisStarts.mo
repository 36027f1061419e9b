within UrdfSync.Dynamics;

function axisStarts "Where axes start if nobody says otherwise"
  extends Modelica.Icons.Function;

  input Real lower[:]
    "Per axis: smallest position";

  input Real upper[size(lower, 1)]
    "Per axis: largest position";

  output Real start[size(lower, 1)]
    "Per axis: position, in the same unit";

algorithm
  start := zeros(size(lower, 1));
  for i in 1:size(lower, 1) loop
    start[i] := UrdfSync.Functions.closestToZero(lower[i], upper[i]);
  end for;

  annotation (Documentation(info="<html>
<p>
At zero, or at the end of the range that is closest to it (<a href=\"modelica://UrdfSync.Functions.closestToZero\">Functions.closestToZero</a>).
</p>
</html>"));
end axisStarts;
