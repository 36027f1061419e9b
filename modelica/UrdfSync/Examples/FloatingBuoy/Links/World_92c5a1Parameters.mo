within UrdfSync.Examples.FloatingBuoy.Links;

record World_92c5a1Parameters "Numbers of link \"world\""
  extends UrdfSync.Records.Link(
    name = "world",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;world&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "92c5a1d8-a4a5", base = "f192d78ca8ba76c0"));
end World_92c5a1Parameters;
