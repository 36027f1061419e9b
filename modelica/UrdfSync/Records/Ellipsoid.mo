within UrdfSync.Records;

record Ellipsoid "Sphere that is stretched along its three axes"
  extends UrdfSync.Records.Shape;

  Modelica.Units.SI.Radius radii[3] = {0.05, 0.05, 0.1}
    "Half axes along x, y and z";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;ellipsoid&gt;</code> element, centred at the origin of the shape frame. The URDF of ROS lacks it, SDF has it.
</p>
</html>"));
end Ellipsoid;
