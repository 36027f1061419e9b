within UrdfSync.Examples.SixAxisArm.Links;

record Tool0Parameters "Numbers of link \"tool0\""
  extends UrdfSync.Records.Link(
    name = "tool0",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;tool0&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "31f781f5-a4a5", base = "922aea703923639c"));
end Tool0Parameters;
