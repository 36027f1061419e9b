within UrdfSync.Dynamics;

function bodyInertias "Inertia tensor of each body about its origin"
  extends Modelica.Icons.Function;

  input Integer linkBodies[:]
    "Per link: number of the body that it is part of; 1 is the base";

  input Real linkRotations[:, 3, 3](each unit = "1")
    "Per link: rotation in its body";

  input Modelica.Units.SI.Position linkPositions[:, 3]
    "Per link: origin in its body";

  input Modelica.Units.SI.Mass linkMasses[:]
    "Per link: mass";

  input Modelica.Units.SI.Position linkCenters[:, 3]
    "Per link: centre of mass in the link frame";

  input Modelica.Units.SI.Angle inertialAngles[:, 3]
    "Per link: roll, pitch and yaw of the inertial frame in the link frame";

  input Modelica.Units.SI.MomentOfInertia linkInertias[:, 6](each min = -Modelica.Constants.inf)
    "Per link: elements {xx, yy, zz, xy, xz, yz} about the centre of mass, in the inertial frame";

  input Integer n
    "Number of moving joints";

  output Modelica.Units.SI.MomentOfInertia J[n + 1, 3, 3](each min = -Modelica.Constants.inf)
    "Per body: tensor about the origin of the body, in its axes";

protected
  Modelica.Units.SI.Position d[3] = zeros(3);
  Modelica.Units.SI.MomentOfInertia I[3, 3](each min = -Modelica.Constants.inf) = zeros(3, 3);
algorithm
  J := zeros(n + 1, 3, 3);
  for k in 1:size(linkBodies, 1) loop
    d := linkPositions[k, :] + linkRotations[k, :, :]*linkCenters[k, :];
    I := UrdfSync.Functions.inertiaInLinkAxes(inertialAngles[k, :], linkInertias[k, :]);
    J[linkBodies[k], :, :] := J[linkBodies[k], :, :] + linkRotations[k, :, :]*I*transpose(linkRotations[k, :, :]) - linkMasses[k]*skew(d)*skew(d);
  end for;

  annotation (Documentation(info="<html>
<p>
The sum over the links of
</p>
<pre>R*I*R' - m*skew(d)*skew(d),   d = r + R*c</pre>
<p>
where <code>R</code> and <code>r</code> place the link in the body, <code>c</code> is its centre of mass in m, and <code>I</code> in kg.m2 its tensor about that, in link axes. The
second term is the rule of parallel axes (Featherstone: Rigid Body Dynamics Algorithms, 2008, section 2.13). A link without mass adds nothing.
</p>
</html>"));
end bodyInertias;
