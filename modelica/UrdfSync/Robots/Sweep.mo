within UrdfSync.Robots;

block Sweep "Smooth way to the roomier end of each range and back"
  extends Modelica.Blocks.Interfaces.MO(final nout = n);

  parameter Integer n(min = 1) = 1
    "Number of axes";

  parameter Real start[n] = zeros(n)
    "Positions at the beginning, in rad or m";

  parameter Real range[n, 3] = fill(1, n, 3)
    "One row per axis: {lower, upper, velocity}";

  parameter Real reach = 1
    "Longest way, in rad or m";

  parameter Modelica.Units.SI.Time period = 10
    "Time of the way there and back";

  final parameter Real turn[n] = UrdfSync.Functions.sweepEnds(start, range, period, reach)
    "Turning points";

equation
  y = start + 0.5*(1 - cos(2*Modelica.Constants.pi*time/period))*(turn - start);

  annotation (Documentation(info="<html>
<p>
Each axis begins at rest, moves along a cosine to its turning point and comes back. Ranges and speed limits are kept with a margin
of 10 %. An axis without room stays where it is.
</p>
</html>"));
end Sweep;
