within UrdfSync.Dynamics;

function toolLink "Number of the link at the end of the longest chain of moving joints"
  extends Modelica.Icons.Function;

  input Integer jointTree[:, 2]
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  input Integer linkBodies[:]
    "Per link: number of the body that it is part of; 1 is the base";

  output Integer tool
    "Number of the link";

protected
  Integer depth[size(jointTree, 1) + 1] = fill(0, size(jointTree, 1) + 1);
algorithm
  tool := 1;
  for i in 1:size(jointTree, 1) loop
    if jointTree[i, 2] > 0 then
      depth[i + 1] := depth[jointTree[i, 1]] + 1;
    end if;
  end for;
  for k in 1:size(linkBodies, 1) loop
    if depth[linkBodies[k]] >= depth[linkBodies[tool]] then
      tool := k;
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
Moving joints are counted from the root; of all links with the greatest number of them it is the last one, in the order of the record. So it is the last of the
links that fixed joints hang on the last moving link, usually a frame for tools. A URDF does not say which link is the tool: where this rule finds
another one, name it by its number.
</p>
</html>"));
end toolLink;
