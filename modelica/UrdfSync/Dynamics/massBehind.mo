within UrdfSync.Dynamics;

function massBehind "Whether joints move any mass"
  extends Modelica.Icons.Function;

  input Integer jointTree[:, 2]
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  input Real bodies[size(jointTree, 1) + 1, 10]
    "One row per body, as bodyInertias gives them";

  input Integer joints[:]
    "Numbers of the joints that follow others, and any number for the empty column of shares";

  input Real shares[size(jointTree, 1), size(joints, 1)]
    "As followerShares gives them";

  output Real mass[size(jointTree, 1)]
    "Per moving joint: a sum of masses and moments of inertia, zero if nothing behind the joint and its followers has any";

protected
  Integer n = size(jointTree, 1);
  Real behind[size(jointTree, 1) + 1] = zeros(size(jointTree, 1) + 1);
  Integer i = 1;
algorithm
  mass := zeros(n);
  for k in 1:n + 1 loop
    behind[k] := bodies[k, 1] + bodies[k, 5] + bodies[k, 6] + bodies[k, 7];
  end for;
  for k in 1:n loop
    i := n + 1 - k;
    behind[jointTree[i, 1]] := behind[jointTree[i, 1]] + behind[i + 1];
  end for;
  for k in 1:n loop
    mass[k] := behind[k + 1];
    for j in 1:size(joints, 1) loop
      mass[k] := mass[k] + shares[k, j]^2*behind[joints[j] + 1];
    end for;
  end for;

  annotation (Documentation(info="<html>
<p>
Only whether a sum is zero has a meaning: then the diagonal of the mass matrix is zero at this joint, in all positions, and its free motion has no solution.
</p>
</html>"));
end massBehind;
