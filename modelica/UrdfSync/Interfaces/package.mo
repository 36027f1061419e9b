within UrdfSync;

package Interfaces "What links and joints of a robot have in common, and may be exchanged for"
  extends Modelica.Icons.InterfacesPackage;

  annotation (Documentation(info="<html>
<p>
In a generated robot each link and each joint is <code>replaceable</code>, constrained by one of these classes. A model of your own that extends
the same class can take its place, in a robot that extends the generated one:
</p>
<pre>
model MyArm \"The arm with an elastic elbow\"
  extends Arm(redeclare MyJoints.ElasticElbow elbow);
end MyArm;
</pre>
<p>
See <a href=\"modelica://UrdfSync.Examples.CustomArm\">Examples.CustomArm</a>.
</p>
</html>"));
end Interfaces;
