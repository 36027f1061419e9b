within UrdfSync.Records;

record Sphere "Sphere, centred at the origin of the shape frame"
  extends UrdfSync.Records.Shape;

  Modelica.Units.SI.Radius radius = 0.05
    "Radius";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;sphere&gt;</code> element of URDF.
</p>
</html>"));
end Sphere;
