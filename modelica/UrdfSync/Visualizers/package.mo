within UrdfSync;

package Visualizers "Shapes of links in the animation"
  extends Modelica.Icons.Package;

  annotation (Documentation(info="<html>
<p>
One model per kind of URDF geometry. Each draws the shape of a record with the animation of the Modelica Standard
Library, at the place that the record says. They have no mass and make no force.
</p>
</html>"));
end Visualizers;
