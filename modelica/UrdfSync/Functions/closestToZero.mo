within UrdfSync.Functions;

function closestToZero "Position inside a range that is closest to zero"
  extends Modelica.Icons.Function;

  input Real lower
    "Lower end of the range";

  input Real upper
    "Upper end of the range";

  output Real q
    "Zero if it is in the range, else the end next to it";

algorithm
  q := min(max(0, lower), upper);

  annotation (Documentation(info="<html>
<p>
Where a joint starts if nobody says otherwise: at zero, the pose that the URDF draws, unless that is out of its limits.
</p>
</html>"));
end closestToZero;
