within UrdfSync;

package Records "Numbers and strings of URDF elements"
  extends Modelica.Icons.RecordsPackage;

  annotation (Documentation(info="<html>
<p>
One record per kind of URDF element. Records hold numbers and strings only: nothing in them switches
a component on or off, so that they can be renewed without touching a model.
</p>
</html>"));
end Records;
