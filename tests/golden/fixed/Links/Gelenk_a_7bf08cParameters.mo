within Zoo.Menagerie.Links;

record Gelenk_a_7bf08cParameters "Numbers of link \"Gelenk_ä\""
  extends UrdfSync.Records.Link(
    name = "Gelenk_ä",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;Gelenk_ä&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end Gelenk_a_7bf08cParameters;
