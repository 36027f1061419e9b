within UrdfSync.Examples.PlanarPlatform.Links;

record WorldLinkParameters "Numbers of link \"world\""
  extends UrdfSync.Records.Link(
    name = "world",
    hasInertial = false);

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0, 0, -0.05},
      rpy = {0, 0, 0}),
    size = {1, 0.8, 0.1},
    color = {82, 82, 87},
    opacity = 1)
    "Visual 1: \"table\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;world&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "92c5a1d8-a4a5", base = "2229ed208db0dd8f"));
end WorldLinkParameters;
