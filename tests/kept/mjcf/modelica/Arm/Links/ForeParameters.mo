within Arm.Links;

record ForeParameters "Numbers of link \"fore\""
  extends UrdfSync.Records.Link(
    name = "fore",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 3,
      inertia(
        ixx = 0.13,
        iyy = 0.10000000000000002,
        izz = 0.05000000000000001,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.2, 0.4, 0.6},
    color = {128, 128, 128},
    opacity = 1)
    "Visual 1";

  UrdfSync.Records.Box collision1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.2, 0.4, 0.6},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;fore&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "4d6281dc-a4a5", base = "183087e83f688d7f"));
end ForeParameters;
