within UrdfSync.Dynamics;

function moved "Inertial parameters of a body, seen from another frame"
  extends Modelica.Icons.Function;

  input Real body[10]
    "{m, m*c[3], xx, yy, zz, xy, xz, yz}: mass, first moment and inertia about the origin of the first frame";

  input Real R[3, 3](each unit = "1")
    "Rotation of the first frame in the second one";

  input Modelica.Units.SI.Position r[3]
    "Origin of the first frame in the second one";

  output Real seen[10]
    "The same in the second frame";

protected
  Real S[3, 3] = skew(r);
  Real h[3] = R*body[2:4];
  Real H[3, 3] = skew(h);
  Real J[3, 3] = R*[body[5], body[8], body[9]; body[8], body[6], body[10]; body[9], body[10], body[7]]*transpose(R)
    - S*H - H*S - body[1]*S*S;
algorithm
  seen := {body[1], h[1] + body[1]*r[1], h[2] + body[1]*r[2], h[3] + body[1]*r[3], J[1, 1], J[2, 2], J[3, 3], J[1, 2], J[1, 3], J[2, 3]};

  annotation (Documentation(info="<html>
<p>
The inertia about the new origin is <code>R*J*R' - S*H - H*S - m*S*S</code> with <code>S = skew(r)</code> and <code>H = skew(R*m*c)</code>: the rule of parallel axes for
points of reference that are not the centre of mass (Featherstone: Rigid Body Dynamics Algorithms, section 2.13). It needs no division by the mass.
</p>
</html>"));
end moved;
