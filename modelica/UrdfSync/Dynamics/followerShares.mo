within UrdfSync.Dynamics;

function followerShares "Motion of followers per motion of the joints at their head"
  extends Modelica.Icons.Function;

  input Integer n
    "Number of moving joints";

  input Integer followers[:, 2]
    "One row per moving joint that follows another one: {its number, number of the joint at the head, 0 if that does not move}";

  input Real followerRatios[size(followers, 1), 2]
    "One row per row of followers: {multiplier, offset}";

  output Real shares[n, size(followers, 1) + 1]
    "One row per moving joint, a column per follower, and an empty one";

algorithm
  shares := zeros(n, size(followers, 1) + 1);
  for k in 1:size(followers, 1) loop
    if followers[k, 2] > 0 then
      shares[max(1, followers[k, 2]), k] := followerRatios[k, 1];
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
Row <code>i</code> times the loads of the followers is what the drive of joint <code>i</code> bears besides its own load (principle of virtual work). The
empty column makes the table one that every tool can multiply, also where nothing follows.
</p>
</html>"));
end followerShares;
