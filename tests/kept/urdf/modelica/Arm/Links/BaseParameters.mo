within Arm.Links;

record BaseParameters "Numbers of link \"base\""
  extends UrdfSync.Records.Link(
    name = "base",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;base&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "cec2c63e-a4a5", base = "ffda7442f107e19d"));
end BaseParameters;
