within UrdfSync.UsersGuide;

class ReleaseNotes "What changed from version to version"
  extends Modelica.Icons.ReleaseNotes;

  annotation (
    preferredView="info",
    Documentation(info="<html>
<h4>Version 1.0.0</h4>
<p>
First version: records, links, seven kinds of joints, friction, mimic couplings, ground contact, shapes, robots and benches, examples. Generic robots
that are read from a record, and functions of their kinematics and dynamics.
</p>
</html>"));
end ReleaseNotes;
