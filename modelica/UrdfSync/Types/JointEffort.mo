within UrdfSync.Types;

type JointEffort = Real(unit = "N.m")
  "Effort of a moving joint in vectors of all joints: torque, or force times 1 m"
  annotation (Documentation(info="<html>
<p>
Joints that turn and joints that slide share vectors, whose elements have one unit: see <a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a>.
</p>
</html>"));
