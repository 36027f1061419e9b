within UrdfSync;

package Dynamics "Kinematics and dynamics of trees of rigid bodies, from the record of a robot"
  extends Modelica.Icons.FunctionsPackage;

  constant Modelica.Units.SI.Length unitLength = 1
    "Makes numbers without unit of the positions of joints that slide";

  annotation (Documentation(info="<html>
<p>
A robot is a tree of bodies: body 1 is the base, moving joint <code>i</code> moves body <code>i + 1</code>, and each body is
one or more links that fixed joints hold together. Parents have smaller numbers than their children. The component <code>tree</code> of a robot's record
says all that the functions need to know of it:
</p>
<pre>
parameter MyRobotParameters data;
UrdfSync.Types.JointPosition q[data.movingJoints];
discrete Modelica.Units.SI.MomentOfInertia M[data.movingJoints, data.movingJoints];
algorithm
  when sample(0, 0.01) then
    M := UrdfSync.Dynamics.massMatrix(data.tree, q);
  end when;
</pre>
<p>
They take <code>data.tree</code> and not <code>data</code>: the language asks for the components of the declared record and no others, and <code>data</code> has one more for each link and
joint. A robot model has the positions and velocities of its joints as <code>robot.q</code> and <code>robot.v</code>.
</p>
<h4>Units</h4>
<p>
Joints that turn and joints that slide stand in the same vectors <code>q</code>, <code>v</code>, <code>a</code> and <code>tau</code>. The elements of an array have one unit in Modelica, so
these are <em>generalized coordinates without unit</em> (Featherstone: Rigid Body Dynamics Algorithms, 2008, section 3.2):
</p>
<pre>
q = phi                   of a joint that turns, in rad, which is 1 in SI
q = s/unitLength          of a joint that slides; unitLength is 1 m
tau = torque              of a joint that turns, in N.m
tau = unitLength*force    of a joint that slides: power is tau*v for both
</pre>
<p>
The numbers are those of rad and m, of N.m and N; only the units differ. All elements of a mass matrix are in kg.m2 then.
</p>
<p>
Everything else is resolved in the frame of the base or of a body.
</p>
</html>"));
end Dynamics;
