within UrdfSync.Examples;

package RobotStudy "One experiment with three robots"
  extends Modelica.Icons.ExamplesPackage;

  annotation (Documentation(info="<html>
<p>
The bench <a href=\"modelica://UrdfSync.Examples.GenericRobot\">GenericRobot</a> with a record, with other numbers in it, and with the record of another
robot. All three drop from where they start, without drives, on a fixed base.
</p>
</html>"));
end RobotStudy;
