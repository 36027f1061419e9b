within UrdfSync.Dynamics;

function axisEnds "Ranges of joints in which all joints that follow them stay in their own ranges, too"
  extends Modelica.Icons.Function;

  input UrdfSync.Types.JointPosition lower[:]
    "Per moving joint: smallest position";

  input UrdfSync.Types.JointPosition upper[:]
    "Per moving joint: largest position";

  input Integer followers[:, 2]
    "One row per moving joint that follows another one, leaders first: {its number, number of its leader, 0 if that does not move}";

  input Real followerMultipliers[:]
    "Per row of followers: motion of the joint per motion of its leader";

  input UrdfSync.Types.JointPosition followerOffsets[:]
    "Per row of followers: position of the joint where its leader is at zero";

  output UrdfSync.Types.JointPosition ends[size(lower, 1), 2]
    "One row per moving joint: {smallest position, largest position}";

protected
  constant UrdfSync.Types.JointPosition far = 1e60
    "Farther than any joint moves, and not so far that arithmetic with it overflows";
  UrdfSync.Types.JointPosition p = 0;
  UrdfSync.Types.JointPosition q = 0;
algorithm
  ends := zeros(size(lower, 1), 2);
  for i in 1:size(lower, 1) loop
    ends[i, :] := {lower[i], upper[i]};
  end for;
  for k in size(followers, 1):-1:1 loop
    if followers[k, 2] > 0 and abs(followerMultipliers[k]) > Modelica.Constants.eps then
      p := (max(-far, min(far, ends[followers[k, 1], 1])) - followerOffsets[k])/followerMultipliers[k];
      q := (max(-far, min(far, ends[followers[k, 1], 2])) - followerOffsets[k])/followerMultipliers[k];
      ends[followers[k, 2], 1] := max(ends[followers[k, 2], 1], min(p, q));
      ends[followers[k, 2], 2] := min(ends[followers[k, 2], 2], max(p, q));
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
The relation <code>q = multiplier*q_leader + offset</code>, solved for the leader at both ends of the follower's range; followers of followers come first.
A multiplier of zero leaves the leader free.
</p>
</html>"));
end axisEnds;
