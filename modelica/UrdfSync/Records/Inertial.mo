within UrdfSync.Records;

record Inertial "Mass properties of a link"
  extends UrdfSync.Icons.Parameters;

  Origin origin
    "Inertial frame in the link frame; its origin is the centre of mass";

  Modelica.Units.SI.Mass mass = 0
    "Mass of the link";

  Inertia inertia
    "Inertia tensor, resolved in the inertial frame";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;inertial&gt;</code> element of URDF. A link without that element has no mass: all numbers are zero.
</p>
</html>"));
end Inertial;
