within UrdfSync.Examples.FloatingBuoy;

package Links "Links of robot FloatingBuoy"
  extends UrdfSync.Icons.LinksPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per link.
</p>
</html>"),
    __urdfsync(id = "18d63be1-afba", base = "7afc13cba2202488"));
end Links;
