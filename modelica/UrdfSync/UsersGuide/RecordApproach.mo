within UrdfSync.UsersGuide;

class RecordApproach "The whole robot as one record"
  extends Modelica.Icons.Information;

  annotation (
    preferredView="info",
    Documentation(info="<html>
<p>
<code>&lt;Robot&gt;Parameters.mo</code> holds all numbers of the robot in one record: name, tables, and one component per link, per visual and per
joint. It extends <a href=\"modelica://UrdfSync.Records.Robot\">Records.Robot</a>. Pign&egrave;de and Oldemeyer call this the model structure
defining record: one generic model can read the structure of any robot from it.
</p>
<pre>
inner Modelica.Mechanics.MultiBody.World world(n = {0, 0, -1});
UrdfSync.Robots.GenericRobot robot(
  redeclare parameter UrdfSync.Examples.SixAxisArm.SixAxisArmParameters data);
equation
  connect(world.frame_b, robot.frame_a);
</pre>
<p>
Another record is another robot. A bench that is to have several declares a replaceable record and uses it for <code>data</code>:
<a href=\"modelica://UrdfSync.Examples.GenericRobot\">Examples.GenericRobot</a> does so, and models of
<a href=\"modelica://UrdfSync.Examples.RobotStudy\">Examples.RobotStudy</a> extend it and redeclare the record. With <code>approach = [\"record\"]</code> in
<code>urdfsync.toml</code> a package is the record and a bench with it; <code>urdfsync record robot.urdf</code> writes the record alone.
</p>
<h4>Tables</h4>
<p>
Links and joints are numbered from 1, depth-first from the root, siblings in natural order of their names. So link 1 is the root, and
joint <code>k</code> leads to link <code>k + 1</code>. Links that fixed joints connect are one body, and are taken as such: body 1 is that of the root link,
moving joint <code>i</code> moves body <code>i + 1</code>. <a href=\"modelica://UrdfSync.Records.Robot\">Records.Robot</a> describes each table.
</p>
<p>
Numbers in the tables are references to the components of links and joints. So each number stands once in the record; a modifier such as
<code>data(elbow(origin(xyz = {0, 0, 0.5})))</code> reaches the motion, and so does an edit by hand.
</p>
<p>
Joints that turn and that slide share the vectors <code>q</code>, <code>v</code>, <code>a</code> and <code>effort</code>, as numbers whose unit is that of the joints that turn;
limits and losses are tables of their own for either kind. <a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a> says how the units fit.
</p>
<p>
In a package that has models of links and joints as well, <code>approach = [\"package\", \"record\"]</code>, those models read the records of their elements. The record of the whole robot is
a copy of these numbers then: an edit in it changes no such model.
</p>
<h4>Shapes</h4>
<p>
The record has a component per visual, <code>forearmVisual1</code> for the first one of link <code>forearm</code>, of the classes that the
package approach has for it. The table <code>visuals</code> refers to them, and the models draw its entries with the shapes of the Modelica Standard Library;
<code>animation = false</code> leaves them out. Meshes are in <code>Resources/</code> of the package; a mesh that is not found is left out, and
<code>urdfsync record</code>, which writes no package, leaves out all of them. Collisions are not drawn, and there is no contact with the ground.
</p>
<h4>Models</h4>
<dl>
<dt><a href=\"modelica://UrdfSync.Robots.GenericRobot\">Robots.GenericRobot</a></dt>
<dd>Newton-Euler equations. Tools solve them for accelerations or for efforts, as the model asks. Take this one first.</dd>
<dt><a href=\"modelica://UrdfSync.Robots.ArticulatedRobot\">Robots.ArticulatedRobot</a></dt>
<dd>Articulated-body equations: explicit in the accelerations, for tools that do not solve the equations of motion as one system of the size of the number of axes.</dd>
<dt><a href=\"modelica://UrdfSync.Robots.MultiBodyGenericRobot\">Robots.MultiBodyGenericRobot</a></dt>
<dd>The published formulation, arrays of multibody components. OpenModelica (sources of August 2026) translated and simulated it, before it had <code>frame_b</code> and shapes; rumoca does not translate it.</dd>
<dt><a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a></dt>
<dd>Functions that take <code>data.tree</code>, which follows from the tables: mass matrix, inverse dynamics, Coriolis and gravity forces, the Jacobian of any link, poses. They can be used
without the models; <a href=\"modelica://UrdfSync.Examples.ComputedTorque\">Examples.ComputedTorque</a> and
<a href=\"modelica://UrdfSync.Examples.ToolPath\">Examples.ToolPath</a> control a robot with them, and
<a href=\"modelica://UrdfSync.Examples.ComputedTorquePackage\">ComputedTorquePackage</a> and <a href=\"modelica://UrdfSync.Examples.ToolPathPackage\">ToolPathPackage</a>
a robot of the package approach. For 40 robots with 2 to 30 moving joints they agree with Pinocchio to 2e-15, relative to the greatest element of a result
or of the mass matrix, as far as rumoca computes them.</dd>
</dl>
<p>
All of them have flanges for the driven axes, damping and dry friction, mimic joints, limits that are checked, and the poses of all links as
<code>r_0</code> and <code>R_0</code>. <code>frame_a</code> is connected to the world, or to a <a href=\"modelica://UrdfSync.Robots.FreeBase\">FreeBase</a>.
</p>
<h4>Both approaches</h4>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">
<tr><th align=\"left\"></th><th align=\"left\">package</th><th align=\"left\">record</th></tr>
<tr><td>text files of the six-axis arm (9 moving joints, 13 links)</td><td>59</td><td>4</td></tr>
<tr><td>their lines</td><td>3,721</td><td>1,437</td></tr>
<tr><td>text files of a humanoid (30 moving joints, 60 links)</td><td>247</td><td>4</td></tr>
<tr><td>their lines</td><td>11,569</td><td>2,807</td></tr>
<tr><td>compiled and simulated, 6 moving joints, driven</td><td>2.4 + 2.2 s</td><td>1.5 + 1.2 s (59 %)</td></tr>
<tr><td>6 moving joints, free</td><td>2.9 + 4.0 s</td><td>2.0 + 1.1 s (45 %)</td></tr>
<tr><td>12 moving joints, 6 of them mimic joints, driven</td><td>4.0 + 6.4 s</td><td>2.5 + 3.3 s (56 %)</td></tr>
<tr><td>12 moving joints, 6 of them mimic joints, free</td><td>3.6 + 6.3 s</td><td>1.8 + 1.8 s (35 %)</td></tr>
<tr><td>16 moving joints, driven</td><td>4.1 + 5.3 s</td><td>2.0 + 5.5 s (81 %)</td></tr>
<tr><td>16 moving joints, free</td><td>3.9 + 5.9 s</td><td>2.0 + 1.7 s (38 %)</td></tr>
<tr><td>30 moving joints, driven</td><td>17.1 + 54.4 s</td><td>2.9 + 34.7 s (53 %)</td></tr>
<tr><td>30 moving joints, free</td><td>16.4 + 81.6 s</td><td>3.0 + 4.2 s (7 %)</td></tr>
<tr><td>joint types</td><td>all six</td><td>revolute, continuous, prismatic, fixed</td></tr>
<tr><td>visuals</td><td>drawn</td><td>drawn</td></tr>
<tr><td>collisions drawn, contact with the ground</td><td>yes</td><td>no</td></tr>
<tr><td>frames to connect parts to</td><td>of all links, by editing</td><td>of the root link and of one that the parameter <code>tool</code> names</td></tr>
<tr><td>what can be edited by hand</td><td>every link, every joint and their connections</td><td>numbers; the bench around the robot</td></tr>
<tr><td>the structure changes</td><td>models are generated again, edits are kept or merged</td><td>the record is generated again</td></tr>
<tr><td>numbers change</td><td>records are written, models are not</td><td>the record is written</td></tr>
<tr><td>many robots in one study</td><td>replaceable models</td><td>a redeclared record</td></tr>
</table>
<p>
Times are seconds of CPU in rumoca 0.10.2 to compile and to simulate 0.01 s, libraries loaded before, package and record (GenericRobot) in the same run;
in brackets the record's sum in percent of the package's. No shapes are drawn there: the 44 shapes of the six-axis arm take rumoca about 2 s more to compile, and
1 s where <code>animation = false</code>. The meshes of the humanoid were not at hand. Driven axes move as prescribed. ArticulatedRobot takes 1.1 to 2.2 times as long as
GenericRobot there, since rumoca solves the system of equations well. Where all axes are driven by
position, most of the time goes into the differentiation of each of these constraints. Other tools were not measured.
</p>
<h4>Limits</h4>
<ul>
<li>A robot with planar, floating or ball joints has a record without tables. <code>urdfsync</code> says so with the line of the URDF, and the models refuse
it by name when a simulation begins. Use the package approach, or change the URDF: a planar joint can be written as two prismatic joints and a
continuous one; a floating joint at the root can be left out, and the robot put on a <code>FreeBase</code>.</li>
<li>A link without mass behind a moving joint usually does no harm if something behind that joint has mass. If the joint has no inertia about or along
its axis, it can be driven by position only: the models name it when a simulation begins, and <code>urdfsync</code> does with the line of the URDF. Of two joints on
the same axis with nothing between them the first can be driven by position only, too: <code>urdfsync</code> and ArticulatedRobot name it,
GenericRobot does not.
ArticulatedRobot refuses every joint without inertia of its own, also where it is driven by position, follows another one, or leads one that has mass.</li>
<li>A robot without any moving joint, also one of a single link, is a rigid body.</li>
<li>Gravity is taken at <code>frame_a</code> and is the same for the whole robot.</li>
</ul>
<p>
rumoca, the compiler behind <code>urdfsync check</code>, has limits of its own. Other tools should not need what is said here.
</p>
<ul>
<li>A replaceable record of the bench may be redeclared from outside by one with the same numbers of links, joints and axes, and other numbers of mass, length and so on. A
bench with the record of another structure is refused (<em>expression shape mismatch</em>): name the record at the robot, as
<a href=\"modelica://UrdfSync.Examples.RobotStudy.Wheeled\">RobotStudy.Wheeled</a> does. A parameter that is redeclared from outside, as in
<code>bench(robot(redeclare parameter … data))</code>, is silently not followed: the record stays that of before. So is a parameter that a model redeclares
where it extends a generic robot.</li>
<li>Where a record extends another one, a modifier of some numbers inside <code>inertial</code>, <code>limits</code> and the like may set the other ones there to
their defaults, silently: give all of them, as <a href=\"modelica://UrdfSync.Examples.RobotStudy.LongArmParameters\">LongArmParameters</a> does. Modifiers in the
declaration of the robot are followed as they stand.</li>
<li>Drives beside the robot need literal numbers as sizes.</li>
<li>Forces can act at <code>frame_b</code>. A body or a sensor that differentiates its position or rotation is refused there (<em>structurally singular system</em>).</li>
<li>A function in an equation is evaluated anew for each element of its result: the functions of <a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a> take more
than a minute for 12 joints. In an algorithm, as in <code>when sample(0, 0.01) then M := UrdfSync.Dynamics.massMatrix(data.tree, q); end when;</code>, it is evaluated once, also for
30 joints. <code>M</code> is a discrete variable then. Assign it as a whole: Jacobians that were assigned to parts of one array were silently zero.</li>
</ul>
</html>"));
end RecordApproach;
