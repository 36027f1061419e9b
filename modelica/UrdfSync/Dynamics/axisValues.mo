within UrdfSync.Dynamics;

function axisValues "Numbers of the driven axes of one kind, from those of all moving joints"
  extends Modelica.Icons.Function;

  input Real x[:]
    "Per moving joint: its number";

  input Integer joints[:]
    "Per axis: number of its moving joint";

  output Real y[size(joints, 1)]
    "Per axis: its number, in the unit of x";

algorithm
  y := zeros(size(joints, 1));
  for k in 1:size(joints, 1) loop
    y[k] := x[joints[k]];
  end for;

  annotation (Documentation(info="<html>
<p>
<code>x[joints]</code>, also where there are no axes.
</p>
</html>"));
end axisValues;
