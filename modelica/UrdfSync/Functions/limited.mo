within UrdfSync.Functions;

function limited "Value between two limits"
  extends Modelica.Icons.Function;

  input Real value
    "Value";

  input Real lower
    "Lower limit";

  input Real upper
    "Upper limit";

  output Real kept
    "The value, or the limit that it passes";

algorithm
  kept := max(lower, min(upper, value));

  annotation (Documentation(info="<html>
<p>
A function, so that passing a limit is no event: the limited value is continuous.
</p>
</html>"));
end limited;
