within UrdfSync.Dynamics;

function sweepTurns "Where axes can go in a given time without passing their limits"
  extends Modelica.Icons.Function;

  input Real start[:]
    "Positions at the beginning, inside their ranges";

  input Real lower[size(start, 1)]
    "Smallest positions";

  input Real upper[size(start, 1)]
    "Largest positions";

  input Real velocity[size(start, 1)]
    "Largest velocities";

  input Modelica.Units.SI.Time period
    "Time of the way there and back along a cosine";

  input Real reach
    "Longest way";

  input Real margin(unit = "1") = 0.9
    "Part of the ranges and of the velocities that is used";

  output Real turn[size(start, 1)]
    "Turning points";

protected
  Real room = 0;
  Real above = 0;
  Real below = 0;
algorithm
  turn := start;
  for k in 1:size(start, 1) loop
    // Every limit may be infinite: it is bounded before it is multiplied.
    room := margin*min(velocity[k], reach*Modelica.Constants.pi/(margin*period))*period/Modelica.Constants.pi;
    above := min(room, margin*min(upper[k] - start[k], reach/margin));
    below := min(room, margin*min(start[k] - lower[k], reach/margin));
    turn[k] := if above >= below then start[k] + above else start[k] - below;
  end for;

  annotation (Documentation(info="<html>
<p>
A sweep is
</p>
<pre>start + (turn - start)*(1 - cos(2*pi*t/period))/2</pre>
<p>
Its largest velocity is <code>pi*abs(turn - start)/period</code>. It goes to the side where there is more room. Positions, velocities and <code>reach</code> are all in rad, or all in m.
</p>
</html>"));
end sweepTurns;
