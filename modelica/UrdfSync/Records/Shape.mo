within UrdfSync.Records;

record Shape "Place and colour of a shape"
  extends UrdfSync.Icons.Parameters;

  Origin origin
    "Shape frame in the link frame";

  Modelica.Mechanics.MultiBody.Types.Color color = {180, 180, 180}
    "Red, green and blue, 0 to 255";

  UrdfSync.Types.Opacity opacity = 1
    "1: opaque, 0: invisible; not every visualizer can show it";

  annotation (Documentation(info="<html>
<p>
What the shapes of visuals and collisions have in common.
</p>
</html>"));
end Shape;
