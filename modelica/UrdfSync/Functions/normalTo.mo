within UrdfSync.Functions;

function normalTo "A unit vector at right angles to a given one"
  extends Modelica.Icons.Function;

  input Real n[3](each unit = "1")
    "Any vector but zero";

  output Real u[3](each unit = "1")
    "Unit vector: the x axis of the parent frame, projected along n; the y axis where n is close to x";

protected
  Real e[3] = if abs(n[1]) < 0.9*sqrt(n*n) then {1, 0, 0} else {0, 1, 0};
  Real p[3] = e - (e*n)/(n*n)*n;
algorithm
  u := p/sqrt(p*p);

  annotation (Documentation(info="<html>
<p>
One step of the Gram-Schmidt process. URDF names the normal of a planar joint only; this function chooses the
first direction in the plane.
</p>
</html>"));
end normalTo;
