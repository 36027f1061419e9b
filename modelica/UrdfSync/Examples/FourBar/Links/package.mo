within UrdfSync.Examples.FourBar;

package Links "Links of robot FourBar"
  extends UrdfSync.Icons.LinksPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per link.
</p>
</html>"),
    __urdfsync(id = "18d63be1-afba", base = "6cc65b4f180f2c8a"));
end Links;
