within UrdfSync.UsersGuide;

class Contact "Whom to tell"
  extends Modelica.Icons.Contact;

  annotation (
    preferredView="info",
    Documentation(info="<html>
<p>
UrdfSync is made by the urdfsync authors and comes with the program <code>urdfsync</code>, under the BSD 3-Clause licence.
</p>
<p>
A report of a fault is most useful with the URDF file (or a cut-down one that shows the fault), the part of <code>urdfsync.toml</code>
that concerns the robot, what <code>urdfsync build</code> printed, and the name and version of the Modelica tool.
</p>
</html>"));
end Contact;
