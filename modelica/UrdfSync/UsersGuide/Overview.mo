within UrdfSync.UsersGuide;

class Overview "What there is, and where to begin"
  extends Modelica.Icons.Information;

  annotation (
    preferredView="info",
    Documentation(info="<html>
<p>
CAD programs export robots as URDF, again and again; control engineers simulate them in Modelica and change the models by hand.
<code>urdfsync build</code> reads the URDF and writes one Modelica package per robot. This library holds what all those packages
need: they use its records, friction, couplings, shapes, contacts, functions and icons. It needs the Modelica Standard Library,
4.0.0 or later, and nothing else.
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">
<tr><th align=\"left\">package</th><th align=\"left\">what it holds</th></tr>
<tr><td><a href=\"modelica://UrdfSync.Examples\">Examples</a></td>
<td>robots that <code>urdfsync</code> generated from the URDF files in <code>Resources/robots</code>, and models by hand that extend or drive them</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Robots\">Robots</a></td>
<td>base classes of stationary and mobile robots and of their benches, and robots that read a whole record</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a></td>
<td>mass matrix, gravity, Jacobian and poses from the tables of a record</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Links\">Links</a>, <a href=\"modelica://UrdfSync.Joints\">Joints</a></td>
<td>link and joint models that stand alone: drop one into any multibody model and give it a record</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Interfaces\">Interfaces</a></td>
<td>what links and joints have in common: a model of your own that extends it can take the place of a generated one</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Couplings\">Couplings</a></td><td>mimic joints</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Drives\">Drives</a></td><td>what moves the joints in Test models</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Friction\">Friction</a></td><td>damping and dry friction of joints</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Contacts\">Contacts</a></td><td>the ground, and what touches it</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Visualizers\">Visualizers</a></td><td>shapes in the animation</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Functions\">Functions</a></td><td>rotations, inertias, ranges</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Records\">Records</a></td><td>the numbers of each kind of URDF element</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Types\">Types</a>, <a href=\"modelica://UrdfSync.Icons\">Icons</a></td>
<td>kinds of numbers, and symbols</td></tr>
</table>
<h4>Where to begin</h4>
<ol>
<li>Open an example and simulate its <code>…Test</code> model: every joint moves inside its limits and comes back.</li>
<li>In a folder with a URDF file, run <code>urdfsync init</code> and then <code>urdfsync build</code>.</li>
<li>Put the folder that <code>urdfsync library</code> prints on the MODELICAPATH and open the new package.</li>
<li>Make it yours: <a href=\"modelica://UrdfSync.Examples.CustomArm\">Examples.CustomArm</a> exchanges joints and attaches parts, without editing a generated
file.</li>
</ol>
<p>
A package per robot, with a record and a model per link and per joint, is the package approach of Pign&egrave;de and Oldemeyer
(see <a href=\"modelica://UrdfSync.UsersGuide.Literature\">Literature</a>). One record and one model for all robots is their record approach: see
<a href=\"modelica://UrdfSync.UsersGuide.RecordApproach\">Record approach</a>.
</p>
</html>"));
end Overview;
