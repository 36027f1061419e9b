within UrdfSync;

package Types "Kinds of numbers that the Modelica Standard Library has no type for"
  extends Modelica.Icons.TypesPackage;

  annotation (Documentation(info="<html>
<p>
Each type holds the unit and the range of one kind of number. All other numbers have types of <code>Modelica.Units.SI</code>.
</p>
</html>"));
end Types;
