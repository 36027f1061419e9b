within UrdfSync.Examples.WheeledRobot.Links;

record Camera_optical_frameParameters "Numbers of link \"camera_optical_frame\""
  extends UrdfSync.Records.Link(
    name = "camera_optical_frame",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;camera_optical_frame&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "8f40afcc-a4a5", base = "7834017d5bfa036a"));
end Camera_optical_frameParameters;
