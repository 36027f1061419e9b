within UrdfSync.Functions;

function inertiaInLinkAxes "Inertia tensor, turned from the inertial frame into the axes of the link"
  extends Modelica.Icons.Function;

  input Modelica.Units.SI.Angle rpy[3]
    "Roll, pitch and yaw of the inertial frame in the link frame";

  input Modelica.Units.SI.MomentOfInertia J[6](each min = -Modelica.Constants.inf)
    "Elements {xx, yy, zz, xy, xz, yz} in the inertial frame";

  output Modelica.Units.SI.MomentOfInertia I[3, 3](each min = -Modelica.Constants.inf)
    "Tensor about the same point, resolved in the link frame";

protected
  Real R[3, 3] = UrdfSync.Functions.rotation(rpy);
algorithm
  I := R*[J[1], J[4], J[5]; J[4], J[2], J[6]; J[5], J[6], J[3]]*transpose(R);

  annotation (Documentation(info="<html>
<p>
<code>I = R*J*transpose(R)</code>, the change of axes of a second-order tensor
(Featherstone: Rigid Body Dynamics Algorithms, section 2.13).
</p>
</html>"));
end inertiaInLinkAxes;
