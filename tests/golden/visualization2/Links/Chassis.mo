within Zoo.Menagerie.Links;

model Chassis "Link \"chassis\""
  extends UrdfSync.Icons.Link;
  extends UrdfSync.Interfaces.PartialLink(
    redeclare ChassisParameters parameters);

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

  Visualization2.Shapes.Primitives.Cube visual1(
    length = parameters.visual1.size[1],
    width = parameters.visual1.size[2],
    height = parameters.visual1.size[3],
    color = parameters.visual1.color,
    transparency = 1 - parameters.visual1.opacity) if animation
    "Visual 1"
    annotation (Placement(transformation(extent={{0, 20}, {20, 40}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation visual2Place(
    animation = false,
    r = parameters.visual2.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.visual2.origin.rpy[3], parameters.visual2.origin.rpy[2], parameters.visual2.origin.rpy[1]}))
    "Place of visual2"
    annotation (Placement(transformation(extent={{-40, 50}, {-20, 70}})));

  Visualization2.Shapes.Primitives.Cylinder visual2(
    n = {0, 1, 0},
    angle = 90,
    length = parameters.visual2.length,
    radius = parameters.visual2.radius,
    color = parameters.visual2.color,
    transparency = 1 - parameters.visual2.opacity) if animation
    "Visual 2"
    annotation (Placement(transformation(extent={{0, 50}, {20, 70}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation visual3Place(
    animation = false,
    r = parameters.visual3.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.visual3.origin.rpy[3], parameters.visual3.origin.rpy[2], parameters.visual3.origin.rpy[1]}))
    "Place of visual3"
    annotation (Placement(transformation(extent={{-40, 80}, {-20, 100}})));

  Modelica.Mechanics.MultiBody.Parts.FixedTranslation visual3LowerPlace(
    animation = false,
    r = {0, 0, -0.5*parameters.visual3.length})
    "Place of the lower end"
    annotation (Placement(transformation(extent={{-14, 76}, {-2, 88}})));

  Visualization2.Shapes.Primitives.Sphere visual3Lower(
    radius = parameters.visual3.radius,
    color = parameters.visual3.color,
    transparency = 1 - parameters.visual3.opacity) if animation
    "Visual 3, lower end"
    annotation (Placement(transformation(extent={{6, 76}, {18, 88}})));

  Modelica.Mechanics.MultiBody.Parts.FixedTranslation visual3UpperPlace(
    animation = false,
    r = {0, 0, 0.5*parameters.visual3.length})
    "Place of the upper end"
    annotation (Placement(transformation(extent={{-14, 92}, {-2, 104}})));

  Visualization2.Shapes.Primitives.Sphere visual3Upper(
    radius = parameters.visual3.radius,
    color = parameters.visual3.color,
    transparency = 1 - parameters.visual3.opacity) if animation
    "Visual 3, upper end"
    annotation (Placement(transformation(extent={{6, 92}, {18, 104}})));

  Visualization2.Shapes.Primitives.Cylinder visual3(
    n = {0, 1, 0},
    angle = 90,
    length = parameters.visual3.length,
    radius = parameters.visual3.radius,
    color = parameters.visual3.color,
    transparency = 1 - parameters.visual3.opacity) if animation
    "Visual 3"
    annotation (Placement(transformation(extent={{26, 80}, {46, 100}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation visual4Place(
    animation = false,
    r = parameters.visual4.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.visual4.origin.rpy[3], parameters.visual4.origin.rpy[2], parameters.visual4.origin.rpy[1]}))
    "Place of visual4"
    annotation (Placement(transformation(extent={{-40, 110}, {-20, 130}})));

  Visualization2.Shapes.Primitives.Sphere visual4(
    radius = parameters.visual4.radius,
    color = parameters.visual4.color,
    transparency = 1 - parameters.visual4.opacity) if animation
    "Visual 4"
    annotation (Placement(transformation(extent={{0, 110}, {20, 130}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation visual5Place(
    animation = false,
    r = parameters.visual5.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.visual5.origin.rpy[3], parameters.visual5.origin.rpy[2], parameters.visual5.origin.rpy[1]}))
    "Place of visual5"
    annotation (Placement(transformation(extent={{-40, 140}, {-20, 160}})));

  Visualization2.Shapes.Files.CADFile visual5(
    filename = Modelica.Utilities.Files.loadResource(parameters.visual5.uri),
    overwriteColor = true,
    color = parameters.visual5.color,
    transparency = 1 - parameters.visual5.opacity) if animation
    "Visual 5"
    annotation (Placement(transformation(extent={{0, 140}, {20, 160}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation visual7Place(
    animation = false,
    r = parameters.visual7.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.visual7.origin.rpy[3], parameters.visual7.origin.rpy[2], parameters.visual7.origin.rpy[1]}))
    "Place of visual7"
    annotation (Placement(transformation(extent={{-40, 170}, {-20, 190}})));

  Visualization2.Shapes.Files.CADFile visual7(
    filename = Modelica.Utilities.Files.loadResource(parameters.visual7.uri),
    overwriteColor = true,
    color = parameters.visual7.color,
    transparency = 1 - parameters.visual7.opacity) if animation
    "Visual 7"
    annotation (Placement(transformation(extent={{0, 170}, {20, 190}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation collision1Place(
    animation = false,
    r = parameters.collision1.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.collision1.origin.rpy[3], parameters.collision1.origin.rpy[2], parameters.collision1.origin.rpy[1]}))
    "Place of collision1"
    annotation (Placement(transformation(extent={{-40, -40}, {-20, -20}})));

  Visualization2.Shapes.Primitives.Cube collision1(
    length = parameters.collision1.size[1],
    width = parameters.collision1.size[2],
    height = parameters.collision1.size[3],
    color = parameters.collision1.color,
    transparency = 1 - parameters.collision1.opacity) if showCollisions
    "Collision 1"
    annotation (Placement(transformation(extent={{0, -40}, {20, -20}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation collision2Place(
    animation = false,
    r = parameters.collision2.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.collision2.origin.rpy[3], parameters.collision2.origin.rpy[2], parameters.collision2.origin.rpy[1]}))
    "Place of collision2"
    annotation (Placement(transformation(extent={{-40, -70}, {-20, -50}})));

  Visualization2.Shapes.Primitives.Cylinder collision2(
    n = {0, 1, 0},
    angle = 90,
    length = parameters.collision2.length,
    radius = parameters.collision2.radius,
    color = parameters.collision2.color,
    transparency = 1 - parameters.collision2.opacity) if showCollisions
    "Collision 2"
    annotation (Placement(transformation(extent={{0, -70}, {20, -50}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation collision3Place(
    animation = false,
    r = parameters.collision3.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.collision3.origin.rpy[3], parameters.collision3.origin.rpy[2], parameters.collision3.origin.rpy[1]}))
    "Place of collision3"
    annotation (Placement(transformation(extent={{-40, -100}, {-20, -80}})));

  Modelica.Mechanics.MultiBody.Parts.FixedTranslation collision3LowerPlace(
    animation = false,
    r = {0, 0, -0.5*parameters.collision3.length})
    "Place of the lower end"
    annotation (Placement(transformation(extent={{-14, -104}, {-2, -92}})));

  Visualization2.Shapes.Primitives.Sphere collision3Lower(
    radius = parameters.collision3.radius,
    color = parameters.collision3.color,
    transparency = 1 - parameters.collision3.opacity) if showCollisions
    "Collision 3, lower end"
    annotation (Placement(transformation(extent={{6, -104}, {18, -92}})));

  Modelica.Mechanics.MultiBody.Parts.FixedTranslation collision3UpperPlace(
    animation = false,
    r = {0, 0, 0.5*parameters.collision3.length})
    "Place of the upper end"
    annotation (Placement(transformation(extent={{-14, -88}, {-2, -76}})));

  Visualization2.Shapes.Primitives.Sphere collision3Upper(
    radius = parameters.collision3.radius,
    color = parameters.collision3.color,
    transparency = 1 - parameters.collision3.opacity) if showCollisions
    "Collision 3, upper end"
    annotation (Placement(transformation(extent={{6, -88}, {18, -76}})));

  Visualization2.Shapes.Primitives.Cylinder collision3(
    n = {0, 1, 0},
    angle = 90,
    length = parameters.collision3.length,
    radius = parameters.collision3.radius,
    color = parameters.collision3.color,
    transparency = 1 - parameters.collision3.opacity) if showCollisions
    "Collision 3"
    annotation (Placement(transformation(extent={{26, -100}, {46, -80}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation collision4Place(
    animation = false,
    r = parameters.collision4.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.collision4.origin.rpy[3], parameters.collision4.origin.rpy[2], parameters.collision4.origin.rpy[1]}))
    "Place of collision4"
    annotation (Placement(transformation(extent={{-40, -130}, {-20, -110}})));

  Visualization2.Shapes.Primitives.Sphere collision4(
    radius = parameters.collision4.radius,
    color = parameters.collision4.color,
    transparency = 1 - parameters.collision4.opacity) if showCollisions
    "Collision 4"
    annotation (Placement(transformation(extent={{0, -130}, {20, -110}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation collision5Place(
    animation = false,
    r = parameters.collision5.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.collision5.origin.rpy[3], parameters.collision5.origin.rpy[2], parameters.collision5.origin.rpy[1]}))
    "Place of collision5"
    annotation (Placement(transformation(extent={{-40, -160}, {-20, -140}})));

  Visualization2.Shapes.Files.CADFile collision5(
    filename = Modelica.Utilities.Files.loadResource(parameters.collision5.uri),
    overwriteColor = true,
    color = parameters.collision5.color,
    transparency = 1 - parameters.collision5.opacity) if showCollisions
    "Collision 5"
    annotation (Placement(transformation(extent={{0, -160}, {20, -140}})));

equation
  connect(frame_a, body.frame_a)
    annotation (Line(points={{-100, 0}, {-40, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, noBody.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 15}, {50, 15}, {50, 0}, {60, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual1Place.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 30}, {-40, 30}}, color={95, 95, 95}, thickness=0.5));
  connect(visual1Place.frame_b, visual1.frame_a)
    annotation (Line(points={{-20, 30}, {0, 30}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual2Place.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 60}, {-40, 60}}, color={95, 95, 95}, thickness=0.5));
  connect(visual2Place.frame_b, visual2.frame_a)
    annotation (Line(points={{-20, 60}, {0, 60}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual3Place.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 90}, {-40, 90}}, color={95, 95, 95}, thickness=0.5));
  connect(visual3Place.frame_b, visual3.frame_a)
    annotation (Line(points={{-20, 90}, {26, 90}}, color={95, 95, 95}, thickness=0.5));
  connect(visual3Place.frame_b, visual3LowerPlace.frame_a)
    annotation (Line(points={{-20, 90}, {-17, 90}, {-17, 82}, {-14, 82}}, color={95, 95, 95}, thickness=0.5));
  connect(visual3LowerPlace.frame_b, visual3Lower.frame_a)
    annotation (Line(points={{-2, 82}, {6, 82}}, color={95, 95, 95}, thickness=0.5));
  connect(visual3Place.frame_b, visual3UpperPlace.frame_a)
    annotation (Line(points={{-20, 90}, {-17, 90}, {-17, 98}, {-14, 98}}, color={95, 95, 95}, thickness=0.5));
  connect(visual3UpperPlace.frame_b, visual3Upper.frame_a)
    annotation (Line(points={{-2, 98}, {6, 98}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual4Place.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 120}, {-40, 120}}, color={95, 95, 95}, thickness=0.5));
  connect(visual4Place.frame_b, visual4.frame_a)
    annotation (Line(points={{-20, 120}, {0, 120}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual5Place.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 150}, {-40, 150}}, color={95, 95, 95}, thickness=0.5));
  connect(visual5Place.frame_b, visual5.frame_a)
    annotation (Line(points={{-20, 150}, {0, 150}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual7Place.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 180}, {-40, 180}}, color={95, 95, 95}, thickness=0.5));
  connect(visual7Place.frame_b, visual7.frame_a)
    annotation (Line(points={{-20, 180}, {0, 180}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, collision1Place.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, -30}, {-40, -30}}, color={95, 95, 95}, thickness=0.5));
  connect(collision1Place.frame_b, collision1.frame_a)
    annotation (Line(points={{-20, -30}, {0, -30}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, collision2Place.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, -60}, {-40, -60}}, color={95, 95, 95}, thickness=0.5));
  connect(collision2Place.frame_b, collision2.frame_a)
    annotation (Line(points={{-20, -60}, {0, -60}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, collision3Place.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, -90}, {-40, -90}}, color={95, 95, 95}, thickness=0.5));
  connect(collision3Place.frame_b, collision3.frame_a)
    annotation (Line(points={{-20, -90}, {26, -90}}, color={95, 95, 95}, thickness=0.5));
  connect(collision3Place.frame_b, collision3LowerPlace.frame_a)
    annotation (Line(points={{-20, -90}, {-17, -90}, {-17, -98}, {-14, -98}}, color={95, 95, 95}, thickness=0.5));
  connect(collision3LowerPlace.frame_b, collision3Lower.frame_a)
    annotation (Line(points={{-2, -98}, {6, -98}}, color={95, 95, 95}, thickness=0.5));
  connect(collision3Place.frame_b, collision3UpperPlace.frame_a)
    annotation (Line(points={{-20, -90}, {-17, -90}, {-17, -82}, {-14, -82}}, color={95, 95, 95}, thickness=0.5));
  connect(collision3UpperPlace.frame_b, collision3Upper.frame_a)
    annotation (Line(points={{-2, -82}, {6, -82}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, collision4Place.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, -120}, {-40, -120}}, color={95, 95, 95}, thickness=0.5));
  connect(collision4Place.frame_b, collision4.frame_a)
    annotation (Line(points={{-20, -120}, {0, -120}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, collision5Place.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, -150}, {-40, -150}}, color={95, 95, 95}, thickness=0.5));
  connect(collision5Place.frame_b, collision5.frame_a)
    annotation (Line(points={{-20, -150}, {0, -150}}, color={95, 95, 95}, thickness=0.5));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-130, -100}, {130, -70}}, textString="m=%{parameters.inertial.mass}")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-100, -170}, {100, 200}})),
    Documentation(info="<html>
<p>
Rigid body, visuals and collisions of the URDF link <code>chassis</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end Chassis;
