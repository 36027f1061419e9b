within UrdfSync;

package Links "Links that stand alone"
  extends UrdfSync.Icons.LinksPackage;

  annotation (Documentation(info="<html>
<p>
Models for robots that are built by hand. They are made from the same templates as the links of generated robots, which
do not use them: a generated model is a copy of its own, and can be changed alone.
</p>
</html>"));
end Links;
