within UrdfSync.Types;

type PositionGain = Real(unit = "1/s")
  "Gain from a position error to a bound of the speed"
  annotation (Documentation(info="<html>
<p>
The attribute <code>k_position</code> of URDF's <code>&lt;safety_controller&gt;</code> element.
</p>
</html>"));
