within UrdfSync.Examples.PlanarPlatform.Joints;

record GlideParameters "Numbers of planar joint \"glide\" from link \"world\" to link \"platform\""
  extends UrdfSync.Records.PlanarJoint(
    name = "glide",
    origin(
      xyz = {-0.1, 0.05, 0},
      rpy = {0, 0, 0}),
    axis = {0, 0, 1},
    translation(
      damping = 0.4,
      friction = 0.02),
    rotation(
      damping = 0.4,
      friction = 0.02));

  annotation (Documentation(info="<html>
<p>
Numbers of planar joint &quot;glide&quot; from link &quot;world&quot; to link &quot;platform&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "5cea8f3f-352d", base = "68b98c91cce009bd"));
end GlideParameters;
