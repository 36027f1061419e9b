within UrdfSync.Dynamics;

function startPositions "Positions of all moving joints where the axes start"
  extends Modelica.Icons.Function;

  input Integer n
    "Number of moving joints";

  input Integer rotationalJoints[:]
    "Per axis that turns: number of its moving joint";

  input Modelica.Units.SI.Angle phi_start[size(rotationalJoints, 1)]
    "Start values of the positions of the axes that turn";

  input Integer translationalJoints[:]
    "Per axis that slides: number of its moving joint";

  input Modelica.Units.SI.Position s_start[size(translationalJoints, 1)]
    "Start values of the positions of the axes that slide";

  input Integer followers[:, 2]
    "One row per moving joint that follows another one: {its number, number of the joint at the head, 0 if that does not move}";

  input Real followerRatios[size(followers, 1), 2]
    "One row per row of followers: {multiplier, offset}";

  output Real q[n]
    "Positions of the moving joints, in rad or m";

algorithm
  q := zeros(n);
  for k in 1:size(rotationalJoints, 1) loop
    if rotationalJoints[k] > 0 then
      q[rotationalJoints[k]] := phi_start[k];
    end if;
  end for;
  for k in 1:size(translationalJoints, 1) loop
    if translationalJoints[k] > 0 then
      q[translationalJoints[k]] := s_start[k];
    end if;
  end for;
  for k in 1:size(followers, 1) loop
    if followers[k, 1] > 0 then
      q[followers[k, 1]] := followerRatios[k, 2] + (if followers[k, 2] > 0 then followerRatios[k, 1]*q[max(1, followers[k, 2])] else 0);
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
Joints that follow others are where the joint at the head puts them.
</p>
</html>"));
end startPositions;
