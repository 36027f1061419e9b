within Arm.Links;

record BaseParameters "Numbers of link \"base\""
  extends UrdfSync.Records.Link(
    name = "base");

  UrdfSync.Records.Box collision1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.2, 0.2, 0.1},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;base&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"));
end BaseParameters;
