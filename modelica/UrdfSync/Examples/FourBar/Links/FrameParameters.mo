within UrdfSync.Examples.FourBar.Links;

record FrameParameters "Numbers of link \"frame\""
  extends UrdfSync.Records.Link(
    name = "frame",
    hasInertial = false);

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0.25, 0.04, 0},
      rpy = {0, 0, 0}),
    size = {0.6, 0.02, 0.12},
    color = {82, 82, 87},
    opacity = 1)
    "Visual 1: \"plate\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;frame&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "37eaa7dd-a4a5", base = "dfa419f896bf18e2"));
end FrameParameters;
