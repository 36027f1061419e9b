within UrdfSync;

package Drives "Gears of joints, and what moves the joints in the Test models of robots"
  extends Modelica.Icons.SourcesPackage;

  annotation (Documentation(info="<html>
<p>
A drive of a Test model acts between the support of a joint and its axis, and stays inside the limits of the joint.
</p>
</html>"));
end Drives;
