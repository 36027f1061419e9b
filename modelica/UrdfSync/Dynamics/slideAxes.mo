within UrdfSync.Dynamics;

function slideAxes "Displacement of each body per motion of its joint"
  extends Modelica.Icons.Function;

  input Integer jointTree[:, 2]
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  input Real jointAxes[:, 3](each unit = "1")
    "Per moving joint: axis in the joint frame, of any length";

  output Modelica.Units.SI.Position e_s[size(jointTree, 1), 3]
    "Per moving joint: vector of one metre along the axis in the joint frame; zero if it turns";

algorithm
  e_s := zeros(size(jointTree, 1), 3);
  for i in 1:size(jointTree, 1) loop
    if jointTree[i, 2] == 2 then
      e_s[i, :] := UrdfSync.Dynamics.unitLength*jointAxes[i, :]/sqrt(jointAxes[i, :]*jointAxes[i, :]);
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
The lower half of the motion subspace of a joint. Its unit is the metre, since positions of joints are numbers without unit:
<a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a> says why.
</p>
</html>"));
end slideAxes;
