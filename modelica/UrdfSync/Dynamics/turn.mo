within UrdfSync.Dynamics;

function turn "Rotation matrix of a turn about an axis"
  extends Modelica.Icons.Function;

  input Real n[3](each unit = "1")
    "Axis: a unit vector";

  input Modelica.Units.SI.Angle q
    "Angle";

  output Real R[3, 3](each unit = "1")
    "v_parent = R*v_child";

protected
  Real c = cos(q);
  Real s = sin(q);
algorithm
  R := [c + n[1]*n[1]*(1 - c), n[1]*n[2]*(1 - c) - n[3]*s, n[1]*n[3]*(1 - c) + n[2]*s;
        n[2]*n[1]*(1 - c) + n[3]*s, c + n[2]*n[2]*(1 - c), n[2]*n[3]*(1 - c) - n[1]*s;
        n[3]*n[1]*(1 - c) - n[2]*s, n[3]*n[2]*(1 - c) + n[1]*s, c + n[3]*n[3]*(1 - c)];

  annotation (Documentation(info="<html>
<p>
<code>R = n n' + (1 - n n')*cos(q) + skew(n)*sin(q)</code>, the formula of Rodrigues (Featherstone: Rigid Body Dynamics Algorithms, section 2.8).
</p>
</html>"));
end turn;
