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
<h4>Ground</h4>
<p>
The ground is the plane <code>z = 0</code> of the world, against whose z axis gravity acts. Every collision shape of every link can
touch it, at the lowest points of the shape itself and not at the origin of its link: a wheel of radius <code>r</code> rests with its
axle at height <code>r</code>. Of a mesh the convex hull counts. Links touch the ground only, not one another.
</p>
<p>
The ground yields a little. At depth <code>p</code> a point with the upward speed <code>v_n</code> is pushed up by
</p>
<blockquote><pre>
f_n = c*p*(1 - d*v_n), never negative
</pre></blockquote>
<p>
and friction acts against its sliding velocity, by up to <code>friction*f_n</code>. Stiffness <code>c</code> and damping <code>d</code>
follow from the weight of the robot, the parameter <code>load</code> of the bench, so that light and heavy robots sink in alike: 0.3 mm
where one point carries the whole weight. There is no stiction and no rolling resistance. The numbers are parameters of
<a href=\"modelica://UrdfSync.Contacts.Ground\">Ground</a>; the function
<a href=\"modelica://UrdfSync.Contacts.Functions.point\">point</a> states the law in full.
</p>
<h4>Start</h4>
<p>
The robot begins upright and at rest, where its lowest collision shape just touches the ground with all joints at their start: that
height is <code>height</code> in the record <code>&hellip;Stance</code> of the robot's package (<code>standingHeight</code> in the record of the whole robot). It then settles. <code>r_start</code> and <code>rpy_start</code> of
the bench let it begin elsewhere, <code>v_start</code> and <code>w_start</code> in motion.
</p>
</html>"));
end MobileRobots;
