within UrdfSync.Types;

type TranslationalSteepness = Real(unit = "s/m", min = 0)
  "How sharply the dry friction of a sliding joint changes its sign around standstill"
  annotation (Documentation(info="<html>
<p>
The number <code>s</code> of the law <code>f*tanh(s*v/2)</code>: at <code>v = 2/s</code> the friction force is at 76 % of <code>f</code>.
</p>
</html>"));
