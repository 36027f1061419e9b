within UrdfSync.Examples.FloatingBuoy.Links;

record WorldLinkParameters "Numbers of link \"world\""
  extends UrdfSync.Records.Link(
    name = "world",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;world&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end WorldLinkParameters;
