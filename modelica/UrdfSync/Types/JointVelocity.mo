within UrdfSync.Types;

type JointVelocity = Real(unit = "1/s")
  "Velocity of a moving joint in vectors of all joints"
  annotation (Documentation(info="<html>
<p>
Joints that turn and joints that slide share vectors, whose elements have one unit: see <a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a>.
</p>
</html>"));
