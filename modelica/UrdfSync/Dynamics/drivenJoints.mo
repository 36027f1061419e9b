within UrdfSync.Dynamics;

function drivenJoints "Which moving joints have drives"
  extends Modelica.Icons.Function;

  input Integer n
    "Number of moving joints";

  input Integer joints[:]
    "Numbers of the joints of all driven axes";

  output Integer driven[n]
    "Per moving joint: 1 if it has a drive, 0 if it follows another one";

algorithm
  driven := fill(0, n);
  for k in 1:size(joints, 1) loop
    driven[joints[k]] := 1;
  end for;

  annotation (Documentation(info="<html>
<p>
A joint that follows another one has no drive of its own.
</p>
</html>"));
end drivenJoints;
