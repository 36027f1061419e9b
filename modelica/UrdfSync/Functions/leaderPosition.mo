within UrdfSync.Functions;

function leaderPosition "Position of a joint at which a joint that follows it is at a given one"
  extends Modelica.Icons.Function;

  input Real multiplier
    "Motion of the follower per motion of the leader; zero counts as one";

  input Real offset
    "Position of the follower where the leader is at zero";

  input Real follower
    "Position of the follower; may be infinite";

  output Real leader
    "Position of the leader";

protected
  constant Real far = 1e60
    "Farther than any joint moves, and not so far that arithmetic with it overflows";
  Real k = if abs(multiplier) > Modelica.Constants.eps then multiplier else 1;
algorithm
  leader := (max(-far, min(far, follower)) - offset)/k;

  annotation (Documentation(info="<html>
<p>
The relation <code>follower = multiplier*leader + offset</code>, solved for the leader.
</p>
</html>"));
end leaderPosition;
