within UrdfSync;

package UsersGuide "User's Guide"
  extends Modelica.Icons.Information;

  annotation (
    preferredView="info",
    DocumentationClass=true,
    Documentation(info="<html>
<p>
UrdfSync is the Modelica side of <code>urdfsync</code>, a program that turns URDF files into Modelica packages and keeps the two
in step.
</p>
<ol>
<li><a href=\"modelica://UrdfSync.UsersGuide.Overview\">Overview</a>: what there is, and where to begin</li>
<li><a href=\"modelica://UrdfSync.UsersGuide.GeneratedPackage\">GeneratedPackage</a>: the files of a robot, its connectors, and how to make
it yours</li>
<li><a href=\"modelica://UrdfSync.UsersGuide.Links\">Links</a>: mass, inertia, shapes</li>
<li><a href=\"modelica://UrdfSync.UsersGuide.Joints\">Joints</a>: motion, limits, losses, mimic</li>
<li><a href=\"modelica://UrdfSync.UsersGuide.MobileRobots\">MobileRobots</a>: free base and ground</li>
<li><a href=\"modelica://UrdfSync.UsersGuide.RecordApproach\">RecordApproach</a>: the whole robot as one record</li>
<li><a href=\"modelica://UrdfSync.UsersGuide.Visualization\">Visualization</a>: shapes, meshes, colours</li>
<li><a href=\"modelica://UrdfSync.UsersGuide.Conventions\">Conventions</a>: frames, units, order, icons</li>
<li><a href=\"modelica://UrdfSync.UsersGuide.Literature\">Literature</a></li>
<li><a href=\"modelica://UrdfSync.UsersGuide.ReleaseNotes\">ReleaseNotes</a></li>
<li><a href=\"modelica://UrdfSync.UsersGuide.Contact\">Contact</a></li>
</ol>
</html>"));
end UsersGuide;
