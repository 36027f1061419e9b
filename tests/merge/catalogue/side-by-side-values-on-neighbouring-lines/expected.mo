record ForearmParameters "Numbers of link \"forearm\""
  extends UrdfSync.Records.Link(
    name = "forearm",
    inertial(
      origin(
        xyz = {0.1118, 0, 0},
        rpy = {0, 0, 0}),
      mass = 1.2,
      inertia(
        ixx = 0.006,
        iyy = 0.03,
        izz = 0.030752)));
  parameter Real gain = 1.05
    "Of the drive";
  Real r = min(a, b);
  Real s = sum(2 * a + 2 * a);
  Body body(m = parameters.mass, animation = false) annotation (Placement(transformation(extent={{0, 0}, {20, 20}})));
end ForearmParameters;
