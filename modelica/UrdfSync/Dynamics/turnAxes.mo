within UrdfSync.Dynamics;

function turnAxes "Turn of each body per motion of its joint"
  extends Modelica.Icons.Function;

  input Integer jointTree[:, 2]
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  input Real jointAxes[:, 3](each unit = "1")
    "Per moving joint: axis in the joint frame, of any length";

  output Real e_t[size(jointTree, 1), 3](each unit = "1")
    "Per moving joint: unit vector along the axis in the joint frame; zero if it slides";

algorithm
  e_t := zeros(size(jointTree, 1), 3);
  for i in 1:size(jointTree, 1) loop
    if jointTree[i, 2] == 1 then
      e_t[i, :] := jointAxes[i, :]/sqrt(jointAxes[i, :]*jointAxes[i, :]);
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
The upper half of the motion subspace of a joint (Featherstone: Rigid Body Dynamics Algorithms, 2008, section 3.5). Axes of any length are taken, as the joints of the
Modelica Standard Library take them.
</p>
</html>"));
end turnAxes;
