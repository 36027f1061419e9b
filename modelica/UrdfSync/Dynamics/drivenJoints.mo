within UrdfSync.Dynamics;

function drivenJoints "Which moving joints have drives"
  extends Modelica.Icons.Function;

  input Integer n
    "Number of moving joints";

  input Integer followers[:, 2]
    "One row per moving joint that follows another one: {its number, number of the joint at the head, 0 if that does not move}";

  output Integer driven[n]
    "Per moving joint: 1 if it has a drive, 0 if it follows another one";

algorithm
  driven := fill(1, n);
  for i in 1:n loop
    for k in 1:size(followers, 1) loop
      if followers[k, 1] == i then
        driven[i] := 0;
      end if;
    end for;
  end for;

  annotation (Documentation(info="<html>
<p>
A joint that follows another one has no drive of its own.
</p>
</html>"));
end drivenJoints;
