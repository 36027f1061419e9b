within UrdfSync.UsersGuide;

class MobileRobots "Free base and ground"
  extends Modelica.Icons.Information;

  annotation (
    preferredView="info",
    Documentation(info="<html>
<p>
Whether a robot is stationary or mobile is not in a URDF: <code>base = \"fixed\"</code> or <code>base = \"floating\"</code> in
<code>urdfsync.toml</code> says it. <code>urdfsync init</code> guesses, and writes down why.
</p>
<h4>Stationary</h4>
<p>
Run and Test connect the root link to the world. In a model of your own connect <code>frame_a</code> to whatever carries the robot.
</p>
<h4>Mobile</h4>
<p>
Run and Test extend <a href=\"modelica://UrdfSync.Robots.PartialMobileBench\">PartialMobileBench</a>: a world, a ground and six degrees of
freedom between the world and the root link.
</p>
<ul>
<li><em>Contact.</em> Every collision shape of every link can touch the ground. The ground pushes at the shape itself, not at the origin
of its link: a wheel of radius <code>r</code> rests with its axle at height <code>r</code>. The ground yields a little, so that forces are
smooth; its stiffness follows from the weight of the robot, the parameter <code>load</code> of the bench. The law and its numbers are in
<a href=\"modelica://UrdfSync.Contacts\">UrdfSync.Contacts</a>. Links touch the ground only, not one another.</li>
<li><em>Start.</em> The robot begins upright and at rest, at the height where its lowest collision shape just touches the ground
with all joints at their start: <code>standingHeight</code> in the robot's record. It then settles into the ground.
<code>r_start</code> and <code>rpy_start</code> of the bench let it begin elsewhere.</li>
</ul>
<p>
Gravity acts along -z of the world, as in URDF; the ground is the plane <code>z = 0</code>.
</p>
</html>"));
end MobileRobots;
