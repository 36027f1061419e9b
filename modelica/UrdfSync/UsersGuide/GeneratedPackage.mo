within UrdfSync.UsersGuide;

class GeneratedPackage "The files of a robot, what you may edit, and what the next build does"
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
<tr><td><code>Arm.mo</code></td><td>the robot: links and joints, placed and connected; frames and flanges outside</td></tr>
<tr><td><code>ArmRun.mo</code></td><td>the robot in its world, with inputs for the positions of
all drives, which are filtered, and outputs for their torques and forces: the model to export as FMU</td></tr>
<tr><td><code>ArmTest.mo</code></td><td>the same with sources that move every joint inside its limits: the quick check</td></tr>
<tr><td><code>ArmParameters.mo</code></td>
<td><a href=\"modelica://UrdfSync.UsersGuide.RecordApproach\">the whole robot as one record</a></td></tr>
<tr><td><code>Resources/</code></td><td>the meshes of the URDF, imported</td></tr>
<tr><td><code>package.mo</code>, <code>package.order</code></td>
<td>in the robot's package and in <code>Links</code> and <code>Joints</code></td></tr>
</table>
<p>
With <code>approach = [\"record\"]</code> in <code>urdfsync.toml</code> there are <code>ArmParameters.mo</code>, the two files of the package and
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">
<tr><th align=\"left\">file</th><th align=\"left\">what it is</th></tr>
<tr><td><code>ArmGeneric.mo</code></td><td><a href=\"modelica://UrdfSync.Robots.GenericRobot\">the generic robot</a> that reads this record, in its world, with
sources that move every joint inside its limits: the quick check. <a href=\"modelica://UrdfSync.Examples.GenericRobot\">Examples.GenericRobot</a> is a bench by
hand</td></tr>
</table>
<p>
with <code>approach = [\"package\", \"record\"]</code> all of them.
</p>
<h4>Models and numbers are apart</h4>
<p>
A link or joint model takes every number of the URDF from its record, the component <code>parameters</code>. Run and Test models hold no number
of the URDF either. So new numbers touch records only. The model of a link or joint is a full copy of its template and extends no other
link or joint: what you change in it changes nothing else.
</p>
<h4>The robot's outside</h4>
<ul>
<li><code>frame_a</code> is the frame of the root link; <code>frame_b</code> holds the frames of the links without children. A constant
named after the link and ending in <code>Frame</code> holds its number.</li>
<li><code>rotationalAxis</code> and <code>rotationalSupport</code> are the flanges of the turning joints,
<code>translationalAxis</code> and <code>translationalSupport</code> those of the sliding joints. A constant named after the joint and
ending in <code>Axis</code> holds its number: write <code>rotationalAxis[robot.elbowAxis]</code>, not
<code>rotationalAxis[3]</code>, and your model stays right when joints are added.</li>
<li>Start values of all axes are vectors in the same order. Unless you say otherwise, an axis starts at zero, or at the end of its range
that is next to zero.</li>
<li><code>animation</code>, <code>showCollisions</code> and <code>checkLimits</code> switch drawing and limit warnings for the whole
robot.</li>
</ul>
<h4>What you may edit</h4>
<p>
Everything. <code>urdfsync</code> compares texts, not times: what it wrote last, what is on disk now, and what it would write now.
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">
<tr><th align=\"left\">the file</th><th align=\"left\">what the next build does</th></tr>
<tr><td>is as <code>urdfsync</code> left it</td><td>writes it if there is something new for it, else does not touch it</td></tr>
<tr><td>was edited, and there is nothing new for it</td><td>keeps it</td></tr>
<tr><td>was edited, and there is something new for it</td>
<td>keeps it and reports a conflict; the other models of this robot wait, so that the package on disk still fits together. Records of
which only numbers change are still written</td></tr>
<tr><td>was deleted</td><td>writes it again and says so</td></tr>
<tr><td>was not written by <code>urdfsync</code></td><td>leaves it and reports a conflict</td></tr>
<tr><td>is no longer generated</td><td>deletes it if it is as <code>urdfsync</code> left it, else keeps it and says so</td></tr>
</table>
<p>
In <code>package.order</code> files <code>urdfsync</code> inserts and removes its own names and leaves all other lines: your own classes
may live in the same package.
</p>
</html>"));
end GeneratedPackage;
