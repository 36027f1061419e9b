within UrdfSync;

package Loops "Constraints that close chains of links"
  extends Modelica.Icons.Package;

  annotation (Documentation(info="<html>
<p>
Links and joints of a URDF are a tree. A four-bar is none: its rocker is held by the ground and by the coupler. So one of its joints is left out of
the tree, and closes the loop from link to link:
</p>
<pre>
ground --- crank_pivot --- crank --- crank_pin --- coupler
   |                                                  |
   +------ rocker_pivot -- rocker --- rocker_pin -----+      rocker_pin closes the loop
</pre>
<p>
<a href=\"modelica://UrdfSync.Loops.Constraint\">Constraint</a> has the equations of such a joint, and
<a href=\"modelica://UrdfSync.Joints.Loop\">Joints.Loop</a> is the whole joint, as robots have it; the four-bar itself is
<a href=\"modelica://UrdfSync.Examples.FourBar\">Examples.FourBar</a>. A joint that closes a loop has no drive, no limits and no losses: give
them to the other joints.
</p>
<p>
<strong>As many equations as the loop needs.</strong> A pin removes five of six freedoms. In a four-bar three of these are gone already, since all its axes
are parallel: five equations would hold them twice, and no compiler solves that. So the pin of a planar loop has two equations, in its plane, and no force
perpendicular to it. Which of a loop's equations are independent, urdfsync finds out.
</p>
<p>
<strong>States.</strong> A four-bar has three joints in its tree, and one freedom: one joint has the states, position and speed, and the positions of the
others follow from them. So the start position of that joint is a start position, while those of the others are guesses, from which the compiler goes
to the closest pose that is closed. Positions at which a loop locks, such as a four-bar with crank and coupler in one line, are no good start for states
of the rocker: there its position says nothing about where the crank goes.
</p>
</html>"));
end Loops;
