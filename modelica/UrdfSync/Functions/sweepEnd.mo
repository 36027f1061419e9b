within UrdfSync.Functions;

function sweepEnd "Where an axis can go in a given time without passing its limits"
  extends Modelica.Icons.Function;

  input Real start
    "Position at the beginning, inside the range";

  input Real lower
    "Smallest position";

  input Real upper
    "Largest position";

  input Real velocity
    "Largest speed";

  input Modelica.Units.SI.Time period
    "Time of the way there and back along a cosine";

  input Real reach
    "Longest way";

  input Real margin(unit = "1") = 0.9
    "Part of the range and of the speed that is used";

  output Real q
    "Turning point";

protected
  Real room = margin*min(velocity, reach*Modelica.Constants.pi/(margin*period))*period/Modelica.Constants.pi;
  Real above = min(room, margin*min(upper - start, reach/margin));
  Real below = min(room, margin*min(start - lower, reach/margin));
algorithm
  q := if above >= below then start + above else start - below;

  annotation (Documentation(info="<html>
<p>
The way is <code>start + (q - start)*(1 - cos(2*pi*t/period))/2</code>; its largest speed is <code>pi*abs(q - start)/period</code>. It goes to the
side where there is more room. No limit is multiplied before it is bounded: limits may be infinite.
</p>
</html>"));
end sweepEnd;
