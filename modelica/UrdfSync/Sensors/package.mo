within UrdfSync;

package Sensors "Sensors of robots"
  extends Modelica.Icons.SensorsPackage;

  annotation (Documentation(info="<html>
<p>
What the <code>&lt;sensor&gt;</code> elements of a URDF measure, with the units, signs and axes of ROS. Noise, delays and rates are left out: a sensor shows what is
there at any time.
</p>
</html>"));
end Sensors;
