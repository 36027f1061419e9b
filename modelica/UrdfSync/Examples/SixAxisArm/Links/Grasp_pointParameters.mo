within UrdfSync.Examples.SixAxisArm.Links;

record Grasp_pointParameters "Numbers of link \"grasp_point\""
  extends UrdfSync.Records.Link(
    name = "grasp_point",
    hasInertial = false);

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;grasp_point&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "138e7918-a4a5", base = "e27de326e6c63671"));
end Grasp_pointParameters;
