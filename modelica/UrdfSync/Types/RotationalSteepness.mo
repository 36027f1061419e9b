within UrdfSync.Types;

type RotationalSteepness = Real(unit = "s/rad", min = 0)
  "How sharply the dry friction of a turning joint changes its sign around standstill"
  annotation (Documentation(info="<html>
<p>
The number <code>s</code> of the law <code>f*tanh(s*w/2)</code>: at <code>w = 2/s</code> the friction torque is at 76 % of <code>f</code>.
</p>
</html>"));
