within UrdfSync.Dynamics;

function axisInertias "Masses and moments of inertia that joints move, those of joints that follow them included"
  extends Modelica.Icons.Function;

  input Real inertias[:]
    "Per moving joint, as jointInertias gives them";

  input Integer followers[:, 2]
    "One row per moving joint that follows another one: {its number, number of the joint at the head, 0 if that does not move}";

  input Real followerRatios[size(followers, 1), 2]
    "One row per row of followers: {multiplier, offset}";

  output Real D[size(inertias, 1)]
    "Per moving joint: zero if neither the joint nor its followers move any";

protected
  Integer head = 1;
algorithm
  D := inertias;
  for k in 1:size(followers, 1) loop
    if followers[k, 2] > 0 then
      head := max(1, followers[k, 2]);
      D[head] := D[head] + followerRatios[k, 1]^2*inertias[followers[k, 1]];
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
What a follower moves counts with the square of its multiplier. What joint and followers move in common is left out: only whether the sum is zero has a meaning.
</p>
</html>"));
end axisInertias;
