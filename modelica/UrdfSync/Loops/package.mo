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
</html>"));
end Loops;
