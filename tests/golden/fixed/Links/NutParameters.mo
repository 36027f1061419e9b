within Zoo.Menagerie.Links;

record NutParameters "Numbers of link \"nut\""
  extends UrdfSync.Records.Link(
    name = "nut",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;nut&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end NutParameters;
