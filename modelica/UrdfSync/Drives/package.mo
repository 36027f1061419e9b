within UrdfSync;

package Drives "Gears of joints, and what moves the joints in the Run and Test models of robots"
  extends Modelica.Icons.SourcesPackage;

  annotation (Documentation(info="<html>
<p>
A drive of a Test model acts between the support of a joint and its axis, and stays inside the limits of the joint.
</p>
<p>
The models whose names end in <code>Servo</code> are drives of Run for joints whose source states a law, as actuators of MuJoCo do.
</p>
</html>"));
end Drives;
