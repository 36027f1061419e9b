within Arm;

package Links "Links of robot Arm"
  extends UrdfSync.Icons.LinksPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per link.
</p>
</html>"));
end Links;
