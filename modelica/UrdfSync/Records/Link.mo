within UrdfSync.Records;

record Link "Numbers of a link"
  extends UrdfSync.Icons.Parameters;

  String name = ""
    "Name of the link in the URDF";

  Inertial inertial
    "Mass properties";

  annotation (Documentation(info="<html>
<p>
What every link has. The record of a generated link adds one component per visual and per collision.
</p>
</html>"));
end Link;
