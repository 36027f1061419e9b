within UrdfSync.Examples;

package CustomArm "The six-axis arm with joints, a payload and a sensor of one's own"
  extends Modelica.Icons.ExamplesPackage;

  annotation (Documentation(info="<html>
<p>
The package <a href=\"modelica://UrdfSync.Examples.SixAxisArm\">SixAxisArm</a> is generated, and is written again when the URDF changes. This one is made by
hand, extends it, and is never touched by <code>urdfsync</code>:
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">
<tr><th align=\"left\">class</th><th align=\"left\">what it shows</th></tr>
<tr><td><a href=\"modelica://UrdfSync.Examples.CustomArm.ElasticElbow\">ElasticElbow</a></td>
<td>a joint around a generated one, with two states more</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Examples.CustomArm.GearedTurret\">GearedTurret</a></td>
<td>a joint with the inertia of its motor</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Examples.CustomArm.Imu\">Imu</a></td>
<td>a part that is attached to a link</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Examples.CustomArm.CustomArm\">CustomArm</a></td>
<td>the robot with these joints in the place of the generated ones, with a payload and the sensor at links in the middle of the chain</td></tr>
<tr><td><a href=\"modelica://UrdfSync.Examples.CustomArm.CustomArmTest\">CustomArmTest</a></td>
<td>the generated test model with this robot: simulate this one</td></tr>
</table>
<p>
Numbers of the URDF stand in none of these classes. So a new mass, length or limit reaches them by the next build of the generated package.
</p>
</html>"));
end CustomArm;
