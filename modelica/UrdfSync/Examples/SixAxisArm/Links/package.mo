within UrdfSync.Examples.SixAxisArm;

package Links "Links of robot SixAxisArm"
  extends UrdfSync.Icons.LinksPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per link.
</p>
</html>"),
    __urdfsync(id = "18d63be1-afba", base = "0bf527ca491a5315"));
end Links;
