within UrdfSync.Records;

record ContactPoints "Corners of the convex hull of a mesh"
  extends UrdfSync.Icons.Parameters;

  Integer n(min = 0) = 0
    "Number of points";

  Modelica.Units.SI.Position points[n, 3] = zeros(n, 3)
    "One point per row, resolved in the shape frame of the mesh";

  annotation (Documentation(info="<html>
<p>
Where the mesh of a collision can touch the ground. No element of URDF: the points are taken from the imported mesh.
</p>
</html>"));
end ContactPoints;
