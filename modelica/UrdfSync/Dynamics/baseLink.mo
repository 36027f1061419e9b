within UrdfSync.Dynamics;

function baseLink "Number of the link that is nobody's child"
  extends Modelica.Icons.Function;

  input Integer connectionMatrix[:, 2]
    "One row per joint: {number of the parent link, number of the child link}";

  output Integer base
    "Number of the link";

algorithm
  base := 1;
  for k in 1:size(connectionMatrix, 1) loop
    for j in 1:size(connectionMatrix, 1) loop
      if connectionMatrix[j, 2] == base then
        base := connectionMatrix[j, 1];
      end if;
    end for;
  end for;

  annotation (Documentation(info="<html>
<p>
From link 1 upwards, as often as it takes, whatever the order of the rows. A robot of one link has no joint: its base is link 1.
</p>
</html>"));
end baseLink;
