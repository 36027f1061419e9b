within UrdfSync.Functions;

function sweepEnds "Where axes can go in a given time without passing their limits"
  extends Modelica.Icons.Function;

  input Real start[:]
    "Positions at the beginning, inside their ranges";

  input Real range[:, 3]
    "One row per axis: {lower, upper, velocity}";

  input Modelica.Units.SI.Time period
    "Time of the way there and back along a cosine";

  input Real reach = 1
    "Longest way, in rad or m";

  input Real margin(unit = "1") = 0.9
    "Part of the ranges and of the speeds that is used";

  output Real q[size(start, 1)]
    "Turning points";

protected
  Real room = 0;
  Real above = 0;
  Real below = 0;
algorithm
  q := start;
  for k in 1:size(start, 1) loop
    room := margin*min(range[k, 3], reach*Modelica.Constants.pi/(margin*period))*period/Modelica.Constants.pi;
    above := min(room, margin*min(range[k, 2] - start[k], reach/margin));
    below := min(room, margin*min(start[k] - range[k, 1], reach/margin));
    q[k] := if above >= below then start[k] + above else start[k] - below;
  end for;

  annotation (Documentation(info="<html>
<p>
A sweep is <code>start + (q - start)*(1 - cos(2*pi*t/period))/2</code>; its largest speed is
<code>pi*abs(q - start)/period</code>. It goes to the side where there is more room. No limit is multiplied before it is bounded:
limits may be infinite.
</p>
</html>"));
end sweepEnds;
