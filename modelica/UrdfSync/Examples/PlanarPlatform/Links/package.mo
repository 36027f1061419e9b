within UrdfSync.Examples.PlanarPlatform;

package Links "Links of robot PlanarPlatform"
  extends UrdfSync.Icons.LinksPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per link.
</p>
</html>"),
    __urdfsync(id = "18d63be1-afba", base = "ac130184f3f92263"));
end Links;
