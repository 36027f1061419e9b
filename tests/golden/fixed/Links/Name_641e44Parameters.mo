within Zoo.Menagerie.Links;

record Name_641e44Parameters "Numbers of link \"name\""
  extends UrdfSync.Records.Link(
    name = "name",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;name&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end Name_641e44Parameters;
