within UrdfSync.Examples;

package Utilities "What several examples share"
  extends Modelica.Icons.UtilitiesPackage;

  annotation (Documentation(info="<html>
<p>
The six-axis arm with motors, once as the package approach has it and once as the record approach has it, and two controllers that fit both.
</p>
</html>"));
end Utilities;
