within Arm.Links;

record ForeParameters "Numbers of link \"fore\""
  extends UrdfSync.Records.Link(
    name = "fore",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 2.6,
      inertia(
        ixx = 1,
        iyy = 1,
        izz = 1,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;fore&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "4d6281dc-a4a5", base = "4ce11d594538656e"));
end ForeParameters;
