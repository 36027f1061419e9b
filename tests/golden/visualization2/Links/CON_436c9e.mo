within Zoo.Menagerie.Links;

model CON_436c9e "Link \"CON\""
  extends UrdfSync.Icons.Link;
  extends UrdfSync.Interfaces.PartialLink(
    redeclare CON_436c9eParameters parameters);

  final parameter Modelica.Units.SI.MomentOfInertia I[3, 3](each min = -Modelica.Constants.inf) = UrdfSync.Functions.inertiaInLinkAxes(
    parameters.inertial.origin.rpy,
    {parameters.inertial.inertia.ixx,
     parameters.inertial.inertia.iyy,
     parameters.inertial.inertia.izz,
     parameters.inertial.inertia.ixy,
     parameters.inertial.inertia.ixz,
     parameters.inertial.inertia.iyz})
    "Inertia tensor about the centre of mass, resolved in frame_a";

  Modelica.Mechanics.MultiBody.Parts.Body body(
    animation = false,
    m = parameters.inertial.mass,
    r_CM = parameters.inertial.origin.xyz,
    I_11 = I[1, 1],
    I_22 = I[2, 2],
    I_33 = I[3, 3],
    I_21 = I[2, 1],
    I_31 = I[3, 1],
    I_32 = I[3, 2]) if parameters.hasInertial
    "Mass and inertia"
    annotation (Placement(transformation(extent={{-40, -10}, {-20, 10}})));

  UrdfSync.Interfaces.NoBody noBody(m = parameters.inertial.mass) if not parameters.hasInertial
    "In place of the body of a link without mass"
    annotation (Placement(transformation(extent={{60, -10}, {80, 10}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation visual1Place(
    animation = false,
    r = parameters.visual1.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.visual1.origin.rpy[3], parameters.visual1.origin.rpy[2], parameters.visual1.origin.rpy[1]}))
    "Place of visual1"
    annotation (Placement(transformation(extent={{-40, 20}, {-20, 40}})));

  Visualization2.Shapes.Primitives.Cylinder visual1(
    n = {0, 1, 0},
    angle = 90,
    length = parameters.visual1.length,
    radius = parameters.visual1.radius,
    color = parameters.visual1.color,
    transparency = 1 - parameters.visual1.opacity) if animation
    "Visual 1"
    annotation (Placement(transformation(extent={{0, 20}, {20, 40}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation collision1Place(
    animation = false,
    r = parameters.collision1.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.collision1.origin.rpy[3], parameters.collision1.origin.rpy[2], parameters.collision1.origin.rpy[1]}))
    "Place of collision1"
    annotation (Placement(transformation(extent={{-40, -40}, {-20, -20}})));

  Visualization2.Shapes.Primitives.Cylinder collision1(
    n = {0, 1, 0},
    angle = 90,
    length = parameters.collision1.length,
    radius = parameters.collision1.radius,
    color = parameters.collision1.color,
    transparency = 1 - parameters.collision1.opacity) if showCollisions
    "Collision 1"
    annotation (Placement(transformation(extent={{0, -40}, {20, -20}})));

equation
  connect(frame_a, body.frame_a)
    annotation (Line(points={{-100, 0}, {-40, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, noBody.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 15}, {50, 15}, {50, 0}, {60, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual1Place.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 30}, {-40, 30}}, color={95, 95, 95}, thickness=0.5));
  connect(visual1Place.frame_b, visual1.frame_a)
    annotation (Line(points={{-20, 30}, {0, 30}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, collision1Place.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, -30}, {-40, -30}}, color={95, 95, 95}, thickness=0.5));
  connect(collision1Place.frame_b, collision1.frame_a)
    annotation (Line(points={{-20, -30}, {0, -30}}, color={95, 95, 95}, thickness=0.5));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-130, -100}, {130, -70}}, textString="m=%{parameters.inertial.mass}")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}})),
    Documentation(info="<html>
<p>
Rigid body, visuals and collisions of the URDF link <code>CON</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end CON_436c9e;
