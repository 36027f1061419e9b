within UrdfSync.Examples.WheeledRobot.Links;

record Caster_forkParameters "Numbers of link \"caster_fork\""
  extends UrdfSync.Records.Link(
    name = "caster_fork",
    inertial(
      origin(
        xyz = {-0.00606, 0, -0.01639},
        rpy = {0, 0.688, 0}),
      mass = 0.32,
      inertia(
        ixx = 0.00020282,
        iyy = 0.000171,
        izz = 0.0001047,
        ixy = 0,
        ixz = -1e-08,
        iyz = 0)));

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0, 0, -0.006},
      rpy = {0, 0, 0}),
    radius = 0.028,
    length = 0.012,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 1: \"bearing\"";

  UrdfSync.Records.Box visual2(
    origin(
      xyz = {-0.006, 0, -0.0145},
      rpy = {0, 0, 0}),
    size = {0.044, 0.04, 0.005},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"crown\"";

  UrdfSync.Records.Box visual3(
    origin(
      xyz = {-0.02, 0.0175, -0.0415},
      rpy = {0, 0.45, 0}),
    size = {0.026, 0.004, 0.062},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 3: \"cheek_left\"";

  UrdfSync.Records.Box visual4(
    origin(
      xyz = {-0.02, -0.0175, -0.0415},
      rpy = {0, 0.45, 0}),
    size = {0.026, 0.004, 0.062},
    color = {173, 178, 184},
    opacity = 1)
    "Visual 4: \"cheek_right\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;caster_fork&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "1dbd3c4f-a4a5", base = "041d0df981d099b0"));
end Caster_forkParameters;
