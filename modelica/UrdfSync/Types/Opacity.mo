within UrdfSync.Types;

type Opacity = Real(unit = "1", min = 0, max = 1)
  "How much a shape hides what is behind it: 1 opaque, 0 invisible"
  annotation (Documentation(info="<html>
<p>
The alpha value of URDF's <code>rgba</code> attribute.
</p>
</html>"));
