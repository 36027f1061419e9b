within Zoo.Menagerie.Links;

record L_arm_link_ff9950Parameters "Numbers of link \"L_arm\""
  extends UrdfSync.Records.Link(
    name = "L_arm",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;L_arm&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end L_arm_link_ff9950Parameters;
