within UrdfSync.Functions;

function isAtMost "Whether a value keeps its upper limit, but for rounding"
  extends Modelica.Icons.Function;

  input Real value
    "Value";

  input Real limit
    "Its upper limit; swap the two for a lower one";

  output Boolean isKept
    "= true, if the value is not above its limit";

protected
  constant Real rounding = 1e-6
    "How far a value may pass its limit: in its own unit, and as a share of itself";

algorithm
  isKept := value - limit <= rounding*(1 + abs(value));

  annotation (Documentation(info="<html>
<p>
Solvers and sources are exact to their tolerances only: a joint that goes to its end passes it by a rounding error, which is no fault of the robot. Limits that are
infinite are kept always.
</p>
</html>"));
end isAtMost;
