within Zoo.Menagerie.Links;

record End_847803Parameters "Numbers of link \"end\""
  extends UrdfSync.Records.Link(
    name = "end",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;end&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end End_847803Parameters;
