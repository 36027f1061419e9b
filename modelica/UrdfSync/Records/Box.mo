within UrdfSync.Records;

record Box "Box, centred at the origin of the shape frame"
  extends UrdfSync.Records.Shape;

  Modelica.Units.SI.Length size[3] = {0.1, 0.1, 0.1}
    "Edges along x, y and z";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;box&gt;</code> element of URDF.
</p>
</html>"));
end Box;
