within UrdfSync.Records;

record Cylinder "Cylinder along z, centred at the origin of the shape frame"
  extends UrdfSync.Records.Shape;

  Modelica.Units.SI.Radius radius = 0.05
    "Radius";

  Modelica.Units.SI.Length length = 0.1
    "Length along z";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;cylinder&gt;</code> element of URDF.
</p>
</html>"));
end Cylinder;
