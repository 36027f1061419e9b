within UrdfSync.Dynamics;

function followerShares "Motion of followers per motion of their leaders"
  extends Modelica.Icons.Function;

  input Integer n
    "Number of moving joints";

  input Integer followers[:, 2]
    "One row per moving joint that follows another one, leaders first: {its number, number of its leader, 0 if that does not move}";

  input Real followerMultipliers[:]
    "Per row of followers: motion of the joint per motion of its leader";

  output Real shares[n, size(followers, 1) + 1](each unit = "1")
    "One row per moving joint, a column per follower, and an empty one";

algorithm
  shares := zeros(n, size(followers, 1) + 1);
  for k in 1:size(followers, 1) loop
    if followers[k, 2] > 0 then
      shares[followers[k, 2], k] := followerMultipliers[k];
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
Row <code>i</code> times the loads of the followers is what joint <code>i</code> bears besides its own load (principle of virtual work). The
empty column makes the table one that every tool can multiply, also where nothing follows.
</p>
</html>"));
end followerShares;
