within UrdfSync.Dynamics;

function startPositions "Positions of all moving joints where the axes start"
  extends Modelica.Icons.Function;

  input Integer n
    "Number of moving joints";

  input Integer rotationalJoints[:]
    "Per axis that turns: number of its moving joint";

  input Modelica.Units.SI.Angle phi_start[:]
    "Start values of the positions of the axes that turn";

  input Integer translationalJoints[:]
    "Per axis that slides: number of its moving joint";

  input Modelica.Units.SI.Position s_start[:]
    "Start values of the positions of the axes that slide";

  input Integer followers[:, 2]
    "One row per moving joint that follows another one, leaders first: {its number, number of its leader, 0 if that does not move}";

  input Real followerMultipliers[:]
    "Per row of followers: motion of the joint per motion of its leader";

  input UrdfSync.Types.JointPosition followerOffsets[:]
    "Per row of followers: position of the joint where its leader is at zero";

  output UrdfSync.Types.JointPosition q[n]
    "Positions of the moving joints";

algorithm
  // rumoca refuses a loop over an empty table that reads it outside of a condition: hence the conditions, which always hold.
  q := zeros(n);
  for k in 1:size(rotationalJoints, 1) loop
    if rotationalJoints[k] > 0 then
      q[rotationalJoints[k]] := phi_start[k];
    end if;
  end for;
  for k in 1:size(translationalJoints, 1) loop
    if translationalJoints[k] > 0 then
      q[translationalJoints[k]] := s_start[k]/UrdfSync.Dynamics.unitLength;
    end if;
  end for;
  for k in 1:size(followers, 1) loop
    if followers[k, 2] > 0 then
      q[followers[k, 1]] := followerMultipliers[k]*q[followers[k, 2]] + followerOffsets[k];
    elseif followers[k, 2] == 0 then
      q[followers[k, 1]] := followerOffsets[k];
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
Joints that follow others are where their leaders put them: <code>q = multiplier*q_leader + offset</code>, leaders first.
</p>
</html>"));
end startPositions;
