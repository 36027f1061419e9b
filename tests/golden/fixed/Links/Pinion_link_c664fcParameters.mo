within Zoo.Menagerie.Links;

record Pinion_link_c664fcParameters "Numbers of link \"pinion\""
  extends UrdfSync.Records.Link(
    name = "pinion",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;pinion&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end Pinion_link_c664fcParameters;
