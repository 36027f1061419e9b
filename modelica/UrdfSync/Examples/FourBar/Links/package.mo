within UrdfSync.Examples.FourBar;

package Links "Links of robot FourBar"
  extends UrdfSync.Icons.LinksPackage;

  annotation (
    Documentation(info="<html>
<p>
One model and one record of numbers per link.
</p>
</html>"));
end Links;
