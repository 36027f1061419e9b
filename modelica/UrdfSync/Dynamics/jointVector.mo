within UrdfSync.Dynamics;

function jointVector "A number per moving joint, from those of the joints that turn and of those that slide"
  extends Modelica.Icons.Function;

  input Integer n
    "Number of moving joints";

  input Integer turning[:]
    "Moving joints that turn";

  input Real ofTurning[:]
    "Their numbers";

  input Integer sliding[:]
    "Moving joints that slide";

  input Real ofSliding[:]
    "Their numbers";

  input Real factor
    "What the numbers of joints that slide are multiplied by, so that they have the unit of the others";

  output Real x[n]
    "Per moving joint: its number";

algorithm
  // rumoca refuses a loop over an empty table that reads it outside of a condition: hence the conditions, which always hold.
  x := zeros(n);
  for k in 1:size(turning, 1) loop
    if turning[k] > 0 then
      x[turning[k]] := ofTurning[k];
    end if;
  end for;
  for k in 1:size(sliding, 1) loop
    if sliding[k] > 0 then
      x[sliding[k]] := factor*ofSliding[k];
    end if;
  end for;

  annotation (Documentation(info="<html>
<p>
The record has limits and losses with their units, so those of joints that turn and that slide are tables of their own.
</p>
</html>"));
end jointVector;
