within UrdfSync;

package Dynamics "Kinematics and dynamics of trees of rigid bodies, from tables"
  extends Modelica.Icons.FunctionsPackage;

  annotation (Documentation(info="<html>
<p>
Functions over the tables of a robot's record. A robot is a tree of bodies: body 1 is the base, moving joint <code>i</code> moves body <code>i + 1</code>, and each body is
one or more links that fixed joints hold together. Parents have smaller numbers than their children.
</p>
<p>
<code>linkFrames</code>, <code>jointFrames</code> and <code>bodyInertias</code> prepare what the other functions take. Everything is resolved in the frame of the base or of a body;
efforts are torques of turning and forces of sliding joints.
</p>
<p>
Robots without moving joints have empty tables. Some loops over joints hold a condition that is always true: rumoca, the compiler behind
<code>urdfsync check</code>, looks into the body of a loop also where there is nothing to go through, but not behind a condition.
</p>
</html>"));
end Dynamics;
