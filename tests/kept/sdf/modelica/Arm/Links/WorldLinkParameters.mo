within Arm.Links;

record WorldLinkParameters "Numbers of link \"world\""
  extends UrdfSync.Records.Link(
    name = "world",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;world&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "92c5a1d8-a4a5", base = "cc4aec5d2f43cad7"));
end WorldLinkParameters;
