within UrdfSync.UsersGuide;

class Joints "Motion, limits, losses, mimic"
  extends Modelica.Icons.Information;

  annotation (
    preferredView="info",
    Documentation(info="<html>
<p>
A joint leads from the link frame of its parent (<code>frame_a</code>) to the link frame of its child (<code>frame_b</code>).
</p>
<div>
<img src=\"modelica://UrdfSync/Resources/Images/joint.png\" alt=\"From the parent frame over the joint frame to the child frame\">
</div>
<h4>Motion</h4>
<p>
First comes the origin: <code>xyz</code> from the parent frame to the joint frame, then <code>rpy</code>, turns about the fixed x, y and z
axes of the parent frame in this order: <code>R = Rz(yaw)*Ry(pitch)*Rx(roll)</code>. Then comes the motion. The axis is a unit vector
in the joint frame.
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">
<tr><th align=\"left\">joint</th><th align=\"left\">motion of frame_b in the joint frame</th><th align=\"left\">variables</th></tr>
<tr><td>fixed</td><td>none</td><td></td></tr>
<tr><td>continuous</td><td>turns about <code>axis</code> without end</td><td><code>phi</code> in rad</td></tr>
<tr><td>revolute</td><td>turns about <code>axis</code> within limits</td><td><code>phi</code> in rad</td></tr>
<tr><td>prismatic</td><td>slides along <code>axis</code> within limits</td><td><code>s</code> in m</td></tr>
<tr><td>planar</td><td>slides along <code>n_x</code> and <code>axis</code> &times; <code>n_x</code>, then turns about
<code>axis</code>, the normal of the plane</td><td>two <code>s</code> in m, <code>phi</code> in rad</td></tr>
<tr><td>floating</td><td>moves freely</td><td>position in m, orientation</td></tr>
<tr><td>ball</td><td>turns in all directions</td><td>orientation</td></tr>
</table>
<p>
URDF does not say which direction in the plane comes first. Here <code>n_x</code> is the x axis of the joint frame, projected on the plane;
the y axis, if the normal is close to x (<a href=\"modelica://UrdfSync.Functions.normalTo\">normalTo</a>).
</p>
<h4>Drives</h4>
<p>
Continuous, revolute and prismatic joints have two flanges. <code>support</code> is the housing of the drive, on the parent's side;
<code>axis</code> is where the drive acts. A positive torque or force at <code>axis</code> pushes in the direction of positive
<code>phi</code> or <code>s</code>. An axis to which nothing is connected moves freely. Planar, floating and ball joints have no flanges.
</p>
<h4>Limits</h4>
<p>
The record holds limits of position (revolute, prismatic), speed and effort. Without a <code>&lt;limit&gt;</code> element all of them are
infinite; in one, <code>lower</code> and <code>upper</code> are zero if left out, <code>velocity</code> and <code>effort</code> infinite.
An <code>acceleration</code> is that of a joint that speeds up, a <code>deceleration</code> that of one that slows down. Jerk is not checked.
No limit holds a joint back: a warning that names the joint reports that it is passed. Effort is what the drive gives at
<code>axis</code>, losses included; where other joints follow, the robot checks the whole of what the drive gives at its connector <code>&hellip;Axis</code>. A joint
that follows has no drive of its own, and its effort is not checked. <code>checkLimits = false</code> silences the warnings.
</p>
<h4>Losses</h4>
<p>
Where the URDF has a <code>&lt;dynamics&gt;</code> element, a friction component sits between <code>support</code> and
<code>axis</code>, with damping <code>d</code>, dry friction <code>f</code> and steepness <code>s</code>:
</p>
<blockquote><pre>
tau = d*w + f*tanh(s*w/2)
</pre></blockquote>
<p>
It acts against the motion. For sliding joints read force for torque and <code>v</code> for <code>w</code>. The second term is the law
<code>2*f/(1 + exp(-s*w)) - f</code> of Pign&egrave;de and Oldemeyer, written so that no speed makes it overflow. There is no stiction:
under load an axis creeps. <a href=\"modelica://UrdfSync.Friction\">Other laws</a> hold: redeclare the joint's class <code>FrictionLaw</code>. Damping is in N&middot;m&middot;s/rad for turning and N&middot;s/m for sliding joints, friction in N&middot;m and N.
A planar joint has one component, with the same two numbers, per direction of motion.
A <a href=\"modelica://UrdfSync.Friction.Ball\">ball</a> has damping against its relative angular velocity, and no dry friction.
</p>
<h4>Mechanisms</h4>
<p>
Where the URDF states the number of a mechanism, such as the stiffness of a spring, the mechanism sits between <code>support</code> and <code>axis</code>. The
<a href=\"modelica://UrdfSync.Records.JointDynamics\">records</a> of <code>dynamics</code> have its law. A mechanism of a joint that follows acts back on the leader.
</p>
<h4>Laws of drives</h4>
<p>
Where the source states the law of a drive, the record of the joint has its gains and limits as <code>servo</code>. In Run, a drive of
<a href=\"modelica://UrdfSync.Drives\">Drives</a> then pushes the axis, and no longer moves it exactly. In a model of your own, connect such a drive between axis and support:
</p>
<blockquote><pre>
UrdfSync.Drives.RotationalPositionServo drive(parameters = robot.elbow.parameters.servo);
</pre></blockquote>
<h4>Mimic</h4>
<p>
A joint with a <code>&lt;mimic&gt;</code> element follows another joint, its leader. A
<a href=\"modelica://UrdfSync.Couplings\">coupling</a> in the robot model ties the two axes:
</p>
<blockquote><pre>
follower = multiplier*leader + offset
tau_leader + multiplier*tau_follower = 0
</pre></blockquote>
<p>
The second equation is the balance of power: what the follower needs, the leader's drive has to give. Leader and follower may be of
different kinds, and a follower may itself be followed. A joint that follows a fixed one is held at its offset. The robot has no
<code>&hellip;Axis</code> and no <code>&hellip;Support</code> for a follower.
</p>
<h4>Loops</h4>
<p>
A robot with loops is no tree: one joint of each loop is left out of the tree and <a href=\"modelica://UrdfSync.Loops\">closes it</a>. It has no flanges, limits or
losses; its variables are <code>gap</code>, <code>f</code> and <code>t</code>. The loops leave fewer freedoms than the tree has joints: as many joints begin where their start
values say, and those of the others are guesses.
</p>
<h4>Start values</h4>
<p>
Position and speed at the beginning are parameters of the joint: <code>robot(elbow(phi_start = 0.5))</code>. With <code>fixedStart = true</code> the simulation begins there; with
<code>false</code> they are guesses, for axes of which a drive prescribes the position.
</p>
<h4>Stored, not modelled</h4>
<p>
<code>&lt;calibration&gt;</code> and <code>&lt;safety_controller&gt;</code> are in the record, for models of your own.
</p>
</html>"));
end Joints;
