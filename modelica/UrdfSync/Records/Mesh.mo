within UrdfSync.Records;

record Mesh "Shape from a file"
  extends UrdfSync.Records.Shape;

  String uri = ""
    "Where the file is, as modelica:// URI; its numbers are metres";

  Modelica.Units.SI.Position lower[3] = {0, 0, 0}
    "Smallest x, y and z of all points, resolved in the shape frame";

  Modelica.Units.SI.Position upper[3] = {0, 0, 0}
    "Largest x, y and z of all points, resolved in the shape frame";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;mesh&gt;</code> element of URDF. The scale of the URDF is already applied to the file.
</p>
</html>"));
end Mesh;
