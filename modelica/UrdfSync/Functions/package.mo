within UrdfSync;

package Functions "Rotations, inertias and ranges"
  extends Modelica.Icons.FunctionsPackage;

  annotation (Documentation(info="<html>
<p>
Functions that turn the numbers of a URDF into what multibody models need.
</p>
</html>"));
end Functions;
