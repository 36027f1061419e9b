within UrdfSync;

package Examples "Robots made by urdfsync, and models that use them"
  extends Modelica.Icons.ExamplesPackage;

  annotation (Documentation(info="<html>
<p>
Each package is what <code>urdfsync build</code> makes of one of the URDF files in <code>Resources/robots</code>. The
<code>...Test</code> models simulate as they are.
</p>
</html>"));
end Examples;
