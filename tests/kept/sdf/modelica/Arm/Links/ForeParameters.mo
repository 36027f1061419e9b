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
        ixx = 1,
        iyy = 1,
        izz = 1,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Box visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    size = {0.1, 0.2, 0.3},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 1: \"tube\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;fore&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "4d6281dc-a4a5", base = "1079371d1b945a03"));
end ForeParameters;
