within Arm;

package Links "Links of robot Arm"
  extends UrdfSync.Icons.LinksPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per link.
</p>
</html>"),
    __urdfsync(id = "18d63be1-afba", base = "0d384714e8cbc41b"));
end Links;
