within UrdfSync.Dynamics;

function movedInertia "Inertia tensor of a body about another point, in other axes"
  extends Modelica.Icons.Function;

  input Modelica.Units.SI.Mass m
    "Mass";

  input Real h[3](each unit = "kg.m")
    "First moment of mass about the first origin, in the first axes";

  input Modelica.Units.SI.MomentOfInertia J[3, 3](each min = -Modelica.Constants.inf)
    "Tensor about the first origin, in the first axes";

  input Real R[3, 3](each unit = "1")
    "Rotation of the first frame in the second one";

  input Modelica.Units.SI.Position r[3]
    "Origin of the first frame in the second one";

  output Modelica.Units.SI.MomentOfInertia moved[3, 3](each min = -Modelica.Constants.inf)
    "Tensor about the second origin, in the second axes";

protected
  Modelica.Units.SI.Position S[3, 3] = skew(r);
  Real H[3, 3](each unit = "kg.m") = skew(R*h);
algorithm
  moved := R*J*transpose(R) - S*H - H*S - m*S*S;

  annotation (Documentation(info="<html>
<p>
<code>R*J*R' - S*H - H*S - m*S*S</code> with <code>S = skew(r)</code> and <code>H = skew(R*h)</code>: the rule of parallel axes for
points of reference that are not the centre of mass (Featherstone: Rigid Body Dynamics Algorithms, 2008, section 2.13). It needs no division by the mass.
</p>
</html>"));
end movedInertia;
