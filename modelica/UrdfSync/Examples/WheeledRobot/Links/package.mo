within UrdfSync.Examples.WheeledRobot;

package Links "Links of robot WheeledRobot"
  extends UrdfSync.Icons.LinksPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per link.
</p>
</html>"),
    __urdfsync(id = "18d63be1-afba", base = "91853a6da5708402"));
end Links;
