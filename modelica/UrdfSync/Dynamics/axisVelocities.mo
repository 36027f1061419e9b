within UrdfSync.Dynamics;

function axisVelocities "Velocities of joints at which no joint that follows them is too fast"
  extends Modelica.Icons.Function;

  input UrdfSync.Types.JointVelocity velocity[:]
    "Per moving joint: largest velocity";

  input Integer followers[:, 2]
    "One row per moving joint that follows another one, leaders first: {its number, number of its leader, 0 if that does not move}";

  input Real followerMultipliers[:]
    "Per row of followers: motion of the joint per motion of its leader";

  output UrdfSync.Types.JointVelocity largest[size(velocity, 1)]
    "Per moving joint: largest velocity, those of its followers respected";

protected
  constant UrdfSync.Types.JointVelocity far = 1e60
    "Faster than any joint moves, and not so fast that arithmetic with it overflows";
algorithm
  largest := velocity;
  for k in size(followers, 1):-1:1 loop
    if followers[k, 2] > 0 and abs(followerMultipliers[k]) > Modelica.Constants.eps then
      largest[followers[k, 2]] := min(largest[followers[k, 2]], min(far, largest[followers[k, 1]])/abs(followerMultipliers[k]));
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
<code>v = multiplier*v_leader</code>, solved for the leader; followers of followers come first.
</p>
</html>"));
end axisVelocities;
