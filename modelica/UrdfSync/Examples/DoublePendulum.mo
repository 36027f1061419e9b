within UrdfSync.Examples;

model DoublePendulum "Links and joints of the library, put together by hand"
  extends Modelica.Icons.Example;

  inner Modelica.Mechanics.MultiBody.World world(n = {0, 0, -1})
    "Origin and gravity"
    annotation (Placement(transformation(extent={{-90, -10}, {-70, 10}})));

  UrdfSync.Joints.Revolute shoulder(
    parameters(
      name = "shoulder",
      axis = {0, 1, 0},
      limits(lower = -2, upper = 2, velocity = 8),
      dynamics(damping = 0.02, friction = 0.01)),
    phi_start = 1)
    "Turns within its limits"
    annotation (Placement(transformation(extent={{-50, -10}, {-30, 10}})));

  UrdfSync.Links.CylinderLink upper(
    parameters(
      inertial(
        origin(xyz = {0, 0, -0.25}),
        mass = 1.2,
        inertia(ixx = 0.025, iyy = 0.025, izz = 0.001)),
      visual1(
        origin(xyz = {0, 0, -0.25}),
        radius = 0.03,
        length = 0.5,
        color = {44, 82, 130})))
    "Half a metre long"
    annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));

  UrdfSync.Joints.Continuous elbow(
    parameters(
      name = "elbow",
      origin(xyz = {0, 0, -0.5}),
      axis = {0, 1, 0},
      dynamics(damping = 0.01)))
    "Turns without end stops"
    annotation (Placement(transformation(extent={{30, -10}, {50, 10}})));

  UrdfSync.Links.SphereLink bob(
    parameters(
      inertial(
        origin(xyz = {0, 0, -0.3}),
        mass = 0.6,
        inertia(ixx = 0.0006, iyy = 0.0006, izz = 0.0006)),
      visual1(
        origin(xyz = {0, 0, -0.3}),
        radius = 0.05,
        color = {186, 98, 20})))
    "Swings below the elbow"
    annotation (Placement(transformation(extent={{70, -10}, {90, 10}})));

equation
  connect(world.frame_b, shoulder.frame_a)
    annotation (Line(points={{-70, 0}, {-50, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(shoulder.frame_b, upper.frame_a)
    annotation (Line(points={{-30, 0}, {-10, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(upper.frame_a, elbow.frame_a)
    annotation (Line(points={{-10, 0}, {-16, 0}, {-16, 20}, {24, 20}, {24, 0}, {30, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(elbow.frame_b, bob.frame_a)
    annotation (Line(points={{50, 0}, {70, 0}}, color={95, 95, 95}, thickness=0.5));

  annotation (
    experiment(StopTime=5, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
A pendulum of two links that swings freely. A joint stands between two link frames and carries the place of its
axis in the parent link with it, as in URDF.
</p>
</html>"));
end DoublePendulum;
