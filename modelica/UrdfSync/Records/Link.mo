within UrdfSync.Records;

record Link "Numbers of a link"
  extends UrdfSync.Icons.Parameters;

  String name = ""
    "Name of the link in the URDF";

  Boolean hasInertial = true
    "= false for a link without mass: its model then has no body; fixed when the model is translated";

  Inertial inertial
    "Mass properties";

  annotation (Documentation(info="<html>
<p>
What every link has. The record of a generated link adds one component per visual and per collision.
</p>
</html>"));
end Link;
