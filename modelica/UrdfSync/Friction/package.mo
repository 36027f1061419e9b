within UrdfSync;

package Friction "Losses of joints"
  extends Modelica.Icons.Package;

  annotation (Documentation(info="<html>
<p>
Viscous damping and dry friction between the two sides of an axis, with the numbers of URDF's
<code>&lt;dynamics&gt;</code> element.
</p>
</html>"));
end Friction;
