within UrdfSync.Types;

type JointAcceleration = Real(unit = "1/s2")
  "Acceleration of a moving joint in vectors of all joints"
  annotation (Documentation(info="<html>
<p>
Joints that turn and joints that slide share vectors, whose elements have one unit: see <a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a>.
</p>
</html>"));
