within UrdfSync.Types;

type JointPosition = Real(unit = "1")
  "Position of a moving joint in vectors of all joints: in rad, or in m divided by 1 m"
  annotation (Documentation(info="<html>
<p>
Joints that turn and joints that slide share vectors, whose elements have one unit: see <a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a>.
</p>
</html>"));
