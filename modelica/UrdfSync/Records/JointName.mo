within UrdfSync.Records;

record JointName "Name of a joint in a table"
  extends UrdfSync.Icons.Parameters;

  String name = ""
    "Name of the joint in the URDF";

  annotation (Documentation(info="<html>
<p>
A table of these is <code>jointNames(name = {first.name, second.name})</code>. A table of strings would do in the language, but not every tool can pick
a message out of one.
</p>
</html>"));
end JointName;
