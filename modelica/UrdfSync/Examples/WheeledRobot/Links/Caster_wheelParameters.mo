within UrdfSync.Examples.WheeledRobot.Links;

record Caster_wheelParameters "Numbers of link \"caster_wheel\""
  extends UrdfSync.Records.Link(
    name = "caster_wheel",
    inertial(
      origin(
        xyz = {0, 0, 0},
        rpy = {0, 0, 0}),
      mass = 0.2,
      inertia(
        ixx = 8.917e-05,
        iyy = 0.00015426,
        izz = 8.917e-05,
        ixy = 0,
        ixz = 0,
        iyz = 0)));

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.04,
    length = 0.026,
    color = {26, 26, 26},
    opacity = 1)
    "Visual 1: \"tread\"";

  UrdfSync.Records.Cylinder visual2(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.006,
    length = 0.044,
    color = {173, 178, 184},
    opacity = 1)
    "Visual 2: \"axle\"";

  UrdfSync.Records.Cylinder collision1(
    origin(
      xyz = {0, 0, 0},
      rpy = {1.5707963, 0, 0}),
    radius = 0.04,
    length = 0.026,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1: \"tread\"";

  annotation (Documentation(info="<html>
<p>
Numbers of link &quot;caster_wheel&quot;. They may be edited: urdfsync then keeps the file and reports when the URDF says something new.
</p>
</html>"),
    __urdfsync(id = "982d147d-a4a5", base = "67aca5a5fe6d2420"));
end Caster_wheelParameters;
