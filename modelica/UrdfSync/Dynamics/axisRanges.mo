within UrdfSync.Dynamics;

function axisRanges "Ranges of axes in which joints that follow them stay in their own ranges, too"
  extends Modelica.Icons.Function;

  input Real jointLimits[:, 4]
    "One row per moving joint: {lower, upper, velocity, effort}";

  input Integer followers[:, 2]
    "One row per moving joint that follows another one: {its number, number of the joint at the head, 0 if that does not move}";

  input Real followerRatios[size(followers, 1), 2]
    "One row per row of followers: {multiplier, offset}";

  input Integer joints[:]
    "Per axis: number of its moving joint";

  output Real range[size(joints, 1), 3]
    "One row per axis: {lower, upper, velocity}";

protected
  Real ranges[size(jointLimits, 1), 3] = jointLimits[:, 1:3];
  Integer head = 1;
algorithm
  range := zeros(size(joints, 1), 3);
  for i in 1:size(followers, 1) loop
    if followers[i, 2] > 0 then
      head := max(1, followers[i, 2]);
      ranges[head, :] := UrdfSync.Functions.leaderRange(ranges[head, :], followerRatios[i, 1], followerRatios[i, 2], jointLimits[followers[i, 1], 1:3]);
    end if;
  end for;
  for i in 1:size(joints, 1) loop
    range[i, :] := ranges[joints[i], :];
  end for;

  annotation (Documentation(info="<html>
<p>
<a href=\"modelica://UrdfSync.Functions.leaderRange\">Functions.leaderRange</a>, for all followers one after the other.
</p>
</html>"));
end axisRanges;
