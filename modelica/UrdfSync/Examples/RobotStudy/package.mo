within UrdfSync.Examples;

package RobotStudy "One experiment with three robots"
  extends Modelica.Icons.ExamplesPackage;

  annotation (Documentation(info="<html>
<p>
The bench <a href=\"modelica://UrdfSync.Examples.GenericRobot\">GenericRobot</a> with a record and with other numbers in it, and the same experiment with another
robot. All three drop from where they start, without drives, on a fixed base.
</p>
</html>"));
end RobotStudy;
