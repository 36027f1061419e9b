within UrdfSync.UsersGuide;

class GeneratedPackage "The files of a robot, its connectors, and how to make it yours"
  extends Modelica.Icons.Information;

  annotation (
    preferredView="info",
    Documentation(info="<html>
<p>
With <code>Arm</code> as the name of the robot's class:
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">
<tr><th align=\"left\">file</th><th align=\"left\">what it is</th></tr>
<tr><td><code>Links/&lt;Link&gt;.mo</code></td><td>model of one link</td></tr>
<tr><td><code>Links/&lt;Link&gt;Parameters.mo</code></td><td>record with the numbers of that link</td></tr>
<tr><td><code>Joints/&lt;Joint&gt;.mo</code></td><td>model of one joint</td></tr>
<tr><td><code>Joints/&lt;Joint&gt;Parameters.mo</code></td><td>record with the numbers of that joint</td></tr>
<tr><td><code>Arm.mo</code></td><td>the robot: links and joints, placed and connected, with connectors by name</td></tr>
<tr><td><code>ArmRun.mo</code></td><td>the robot in its world, with an input per drive for its position, which is filtered, and an
output for its torque or force: the model to export as FMU</td></tr>
<tr><td><code>ArmTest.mo</code></td><td>the same with a <a href=\"modelica://UrdfSync.Drives\">drive</a> per joint that moves it inside its limits: the quick
check</td></tr>
<tr><td><code>ArmStance.mo</code></td><td>of mobile robots: the height at which <a href=\"modelica://UrdfSync.UsersGuide.MobileRobots\">the robot stands</a></td></tr>
<tr><td><code>Resources/</code></td><td>the meshes of the URDF, imported</td></tr>
<tr><td><code>package.mo</code>, <code>package.order</code></td>
<td>in the robot's package and in <code>Links</code> and <code>Joints</code></td></tr>
</table>
<p>
With <code>approach = [\"record\"]</code> in <code>urdfsync.toml</code> the two files of the package are there, and
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">
<tr><th align=\"left\">file</th><th align=\"left\">what it is</th></tr>
<tr><td><code>ArmParameters.mo</code></td>
<td><a href=\"modelica://UrdfSync.UsersGuide.RecordApproach\">the whole robot as one record</a></td></tr>
<tr><td><code>ArmGeneric.mo</code></td><td><a href=\"modelica://UrdfSync.Robots.GenericRobot\">the generic robot</a> that reads this record, in its world, with
sources that move every joint inside its limits: the quick check. <a href=\"modelica://UrdfSync.Examples.GenericRobot\">Examples.GenericRobot</a> is a bench by
hand</td></tr>
</table>
<p>
with <code>approach = [\"package\", \"record\"]</code> all of them; the record of the whole robot is then a copy of the numbers, which no link or joint model
reads.
</p>
<h4>Models and numbers are apart</h4>
<p>
A link or joint model takes every number of the URDF from its record, the component <code>parameters</code>. No other class of the package holds such a number,
so each stands once, and new numbers touch records only. A number can be changed on the way, in Run, Test or a model of your own:
<code>robot(forearm(parameters(inertial(mass = 4))))</code>. The model of a link or joint is a full copy of its template and extends no other
link or joint: what you change in it changes nothing else.
</p>
<h4>The robot's outside</h4>
<p>
Whatever can be connected has a name of its own, made from the name of its link or joint. A link or joint more changes no other name.
</p>
<ul>
<li><code>frame_a</code> is the frame of the root link. A link without children has its frame, <code>grasp_pointFrame</code>; so has any other link that the option
<code>frames</code> asks for. A model that extends the robot can connect to <code>forearm.frame_a</code> of every link.</li>
<li>A joint that can be driven has its axis and the housing of its drive, <code>elbowAxis</code> and <code>elbowSupport</code>. Joints that follow another one,
planar, floating and ball joints have none.</li>
<li>With the option <code>drives = \"motor\"</code> a joint whose URDF has a gear or a rotor has the flange of its motor, too: <code>elbowMotor</code>.</li>
<li>A sensor of the URDF is a component of <a href=\"modelica://UrdfSync.Sensors\">Sensors</a>, with its numbers in <code>MyRobotSensors</code>, and a camera or laser scanner
has a frame. Run has what the others measure as outputs.</li>
<li>If a link or joint has such a name already, the connector gives way: it is <code>elbowAxis_2</code> then.</li>
<li>Start values stand at the joints: <code>elbow(phi_start = 0.5)</code>, <code>lift(s_start = 0.1)</code>, and <code>w_start</code>, <code>v_start</code> for speeds.
Unless you say otherwise, a joint starts at zero, or at the end of its range that is next to zero. <code>fixedStart = false</code> makes them guesses, for axes that
are driven by position.</li>
<li><code>animation</code>, <code>showCollisions</code> and <code>checkLimits</code> switch drawing and limit warnings for the whole
robot.</li>
</ul>
<h4>Run and Test</h4>
<ul>
<li>Run has inputs and outputs named after their joints: <code>elbow_phi</code> in rad and <code>elbow_tau</code> in N&middot;m where a joint turns,
<code>lift_s</code> in m and <code>lift_f</code> in N where it slides. So the variables of an FMU keep their names when the robot changes. The option
<code>inputs = \"vector\"</code> gives one vector of positions instead.</li>
<li>Test has a drive per joint, <code>elbowDrive</code>, a <a href=\"modelica://UrdfSync.Drives.RotationalSweep\">RotationalSweep</a> or
<a href=\"modelica://UrdfSync.Drives.TranslationalSweep\">TranslationalSweep</a>.</li>
<li>Both drive the joints that the URDF drives, or those that the option <code>driven</code> names.</li>
</ul>
<h4>Making it yours</h4>
<p>
Links and joints are <code>replaceable</code>, constrained by <a href=\"modelica://UrdfSync.Interfaces\">Interfaces</a>, and so is the robot in Run and Test. A
model that extends the robot, <code>extends Arm(redeclare ElasticElbow elbow)</code>, can never be in conflict with an export.
<a href=\"modelica://UrdfSync.Examples.CustomArm\">Examples.CustomArm</a> exchanges two joints, attaches parts to links and runs in the generated test model.
</p>
<p>
Every generated file may be edited, too. A build never writes over an edit: if the export changes the same file, it reports a conflict. Your own classes may live in the
same package: in <code>package.order</code> files a build inserts and removes its own names only.
</p>
<p>
The pages <code>docs/extending.md</code>, <code>docs/templates.md</code> and <code>docs/conflicts.md</code> of urdfsync say more.
</p>
</html>"));
end GeneratedPackage;
