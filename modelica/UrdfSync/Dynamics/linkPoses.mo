within UrdfSync.Dynamics;

function linkPoses "Forward kinematics: where all links are"
  extends Modelica.Icons.Function;

  input Integer jointTree[:, 2]
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  input Real frames[size(jointTree, 1), 15]
    "One row per moving joint, as jointFrames gives them";

  input Integer linkBodies[:]
    "Per link: number of the body that it is part of; 1 is the base";

  input Real links[size(linkBodies, 1), 12]
    "One row per link, as linkFrames gives them";

  input Real q[size(jointTree, 1)]
    "Positions of the moving joints, in rad or m";

  input Real R_base[3, 3](each unit = "1") = identity(3)
    "Rotation of the base frame in the frame of reference: v_reference = R_base*v_base";

  input Modelica.Units.SI.Position r_base[3] = zeros(3)
    "Origin of the base frame in the frame of reference";

  output Real poses[size(linkBodies, 1), 12]
    "One row per link: {rotation matrix by rows, position}";

protected
  Real R[size(jointTree, 1) + 1, 3, 3] = zeros(size(jointTree, 1) + 1, 3, 3);
  Real r[size(jointTree, 1) + 1, 3] = zeros(size(jointTree, 1) + 1, 3);
  Real Q[3, 3] = identity(3);
  Integer p = 1;
algorithm
  poses := zeros(size(linkBodies, 1), 12);
  R[1, :, :] := R_base;
  r[1, :] := r_base;
  for i in 1:size(jointTree, 1) loop
    if jointTree[i, 2] > 0 then
      p := jointTree[i, 1];
      Q := R[p, :, :]*UrdfSync.Dynamics.rotationOf(frames[i, :]);
      r[i + 1, :] := r[p, :] + R[p, :, :]*frames[i, 10:12];
      if jointTree[i, 2] == 2 then
        R[i + 1, :, :] := Q;
        r[i + 1, :] := r[i + 1, :] + Q*frames[i, 13:15]*q[i];
      else
        R[i + 1, :, :] := Q*UrdfSync.Dynamics.turn(frames[i, 13:15], q[i]);
      end if;
    end if;
  end for;
  for k in 1:size(linkBodies, 1) loop
    p := linkBodies[k];
    Q := R[p, :, :]*UrdfSync.Dynamics.rotationOf(links[k, :]);
    poses[k, 1:3] := Q[1, :];
    poses[k, 4:6] := Q[2, :];
    poses[k, 7:9] := Q[3, :];
    poses[k, 10:12] := r[p, :] + R[p, :, :]*links[k, 10:12];
  end for;

  annotation (Documentation(info="<html>
<p>
From the base outwards, body by body, then each link in its body.
</p>
</html>"));
end linkPoses;
