within UrdfSync.Dynamics;

function axisInertias "Moments of inertia that joints move, those of joints that follow them included"
  extends Modelica.Icons.Function;

  input Modelica.Units.SI.MomentOfInertia inertias[:]
    "Per moving joint, as jointInertias gives them";

  input Integer followers[:, 2]
    "One row per moving joint that follows another one, leaders first: {its number, number of its leader, 0 if that does not move}";

  input Real followerMultipliers[:]
    "Per row of followers: motion of the joint per motion of its leader";

  output Modelica.Units.SI.MomentOfInertia D[size(inertias, 1)]
    "Per moving joint: zero if neither the joint nor its followers move any";

algorithm
  D := inertias;
  for k in size(followers, 1):-1:1 loop
    if followers[k, 2] > 0 then
      D[followers[k, 2]] := D[followers[k, 2]] + followerMultipliers[k]^2*D[followers[k, 1]];
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
What a follower moves counts with the square of its multiplier: <code>D + sum(k^2*D_follower)</code>, followers of followers first. What joint and followers move in common is left out:
only whether the sum is zero has a meaning.
</p>
</html>"));
end axisInertias;
