within UrdfSync.Records;

record Capsule "Cylinder along z with half spheres at both ends"
  extends UrdfSync.Records.Shape;

  Modelica.Units.SI.Radius radius = 0.05
    "Radius of cylinder and half spheres";

  Modelica.Units.SI.Length length = 0.1
    "Length of the cylinder along z, without the half spheres";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;capsule&gt;</code> element of URDF, centred at the origin of the shape frame.
</p>
</html>"));
end Capsule;
