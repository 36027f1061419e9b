within UrdfSync.Functions;

function leaderRange "Range of a joint in which a joint that follows it stays in its own range, too"
  extends Modelica.Icons.Function;

  input Real leader[3]
    "{lower, upper, velocity} of the joint that is followed";

  input Real multiplier
    "Motion of the follower per motion of the leader";

  input Real offset
    "Position of the follower where the leader is at zero";

  input Real follower[3]
    "{lower, upper, velocity} of the joint that follows";

  output Real range[3]
    "{lower, upper, velocity} that respect both";

protected
  Real k = if abs(multiplier) > Modelica.Constants.eps then multiplier else 1;
  constant Real far = 1e60
    "Farther than any joint moves, and not so far that arithmetic with it overflows";
  Real p = (max(-far, min(far, follower[1])) - offset)/k;
  Real q = (max(-far, min(far, follower[2])) - offset)/k;
algorithm
  range := leader;
  if abs(multiplier) > Modelica.Constants.eps then
    range[1] := max(leader[1], min(p, q));
    range[2] := min(leader[2], max(p, q));
    range[3] := min(leader[3], min(far, follower[3])/abs(k));
  end if;

  annotation (Documentation(info="<html>
<p>
The relation follower = multiplier * leader + offset, solved for the leader at both ends of the follower's range.
A multiplier of zero leaves the leader free.
</p>
</html>"));
end leaderRange;
