within UrdfSync.Records;

record Stance "How a mobile robot stands at the beginning"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.Position height = 1
    "Height of the root frame at which the lowest collision shape just touches the ground";

  annotation (Documentation(info="<html>
<p>
What belongs to a mobile robot as a whole. The height follows from the collision shapes and the start positions of the joints.
</p>
</html>"));
end Stance;
