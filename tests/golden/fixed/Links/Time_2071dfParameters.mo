within Zoo.Menagerie.Links;

record Time_2071dfParameters "Numbers of link \"time\""
  extends UrdfSync.Records.Link(
    name = "time",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;time&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end Time_2071dfParameters;
