within UrdfSync.Records;

record Visuals "Shapes of all visuals, as they are drawn"
  extends UrdfSync.Icons.Parameters;

  parameter Integer links[:] = fill(0, 0)
    "Numbers of the links"
    annotation (Evaluate=true);

  String kinds[:] = fill("", 0)
    "Shape types of the Modelica Standard Library: box, cylinder, sphere, or a file as modelica:// URI";

  parameter Integer lengthAxes[:] = fill(0, 0)
    "Axes of the shape frames along which the lengths are: 1 is x, 3 is z"
    annotation (Evaluate=true);

  Modelica.Units.SI.Position positions[:, 3] = fill(0, 0, 3)
    "Origins of the shape frames in the link frames";

  Modelica.Units.SI.Angle angles[:, 3] = fill(0, 0, 3)
    "Roll, pitch and yaw of the shape frames in the link frames";

  Modelica.Units.SI.Position starts[:] = fill(0, 0)
    "Where the shapes begin on their length axes";

  Modelica.Units.SI.Length sizes[:, 3] = fill(0, 0, 3)
    "{length, width, height}; files are drawn as they are, with ones here";

  Integer colors[:, 3] = fill(0, 0, 3)
    "Red, green and blue, 0 to 255";

  annotation (Documentation(info="<html>
<p>
A table of <a href=\"modelica://UrdfSync.Records.Robot\">Records.Robot</a>: one entry per shape that is drawn. Its numbers refer to the records of the
visuals. A capsule is drawn as three shapes, a cylinder and two spheres.
</p>
</html>"));
end Visuals;
