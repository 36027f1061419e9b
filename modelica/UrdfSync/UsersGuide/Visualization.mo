within UrdfSync.UsersGuide;

class Visualization "Shapes, meshes, colours"
  extends Modelica.Icons.Information;

  annotation (
    preferredView="info",
    Documentation(info="<html>
<p>
Links draw their shapes by the animation of the Modelica Standard Library, through
<a href=\"modelica://UrdfSync.Visualizers\">UrdfSync.Visualizers</a>. It does not show opacity. The
<a href=\"modelica://UrdfSync.UsersGuide.RecordApproach\">generic robots</a> draw visuals in the same way.
</p>
<h4>Shapes</h4>
<p>
Boxes, cylinders, capsules, spheres and ellipsoids are centred at the origin of their element; cylinders and capsules lie along z. Colours are red, green
and blue from 0 to 255, rounded from the <code>rgba</code> of the URDF; a material that is defined once for the robot is looked up, and
a visual without colour is grey. Collision shapes are pink; with <code>collisions = false</code> in <code>urdfsync.toml</code> there
are none.
</p>
<h4>Meshes</h4>
<p>
<code>urdfsync</code> imports meshes into <code>Resources/</code> of the robot's package and addresses them by <code>modelica://</code>
URIs. STL and OBJ files without a scale are taken as they are, others are converted to STL with their scale and unit of length, so that the
numbers in the file are metres. Whether your tool draws a format is up to the tool. A mesh that is not found is a warning of the build, and
its shape is left out; if an earlier build imported it, that copy stays in use. With <code>meshes = \"skip\"</code> all meshes are left
out.
</p>
</html>"));
end Visualization;
