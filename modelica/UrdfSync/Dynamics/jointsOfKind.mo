within UrdfSync.Dynamics;

function jointsOfKind "Moving joints that turn, or those that slide"
  extends Modelica.Icons.Function;

  input Integer jointTree[:, 2]
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  input Integer kind
    "1 for joints that turn, 2 for joints that slide";

  input Integer n
    "How many there are";

  output Integer joints[n]
    "Their numbers among all moving joints";

protected
  Integer k = 0;
algorithm
  joints := fill(0, n);
  for i in 1:size(jointTree, 1) loop
    if jointTree[i, 2] == kind then
      k := k + 1;
      joints[k] := i;
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
For models with one array of components per kind of joint.
</p>
</html>"));
end jointsOfKind;
