within UrdfSync.Examples.WheeledRobot.Links;

model Base_link "Link \"base_link\""
  extends UrdfSync.Icons.Link;
  extends UrdfSync.Interfaces.PartialLink(
    redeclare Base_linkParameters parameters);

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

  UrdfSync.Visualizers.Mesh visual1(
    parameters = parameters.visual1,
    animation = animation)
    "Visual 1"
    annotation (Placement(transformation(extent={{-40, 20}, {-20, 40}})));

  UrdfSync.Visualizers.Box visual2(
    parameters = parameters.visual2,
    animation = animation)
    "Visual 2"
    annotation (Placement(transformation(extent={{-40, 50}, {-20, 70}})));

  UrdfSync.Visualizers.Box visual3(
    parameters = parameters.visual3,
    animation = animation)
    "Visual 3"
    annotation (Placement(transformation(extent={{-40, 80}, {-20, 100}})));

  UrdfSync.Visualizers.Box visual4(
    parameters = parameters.visual4,
    animation = animation)
    "Visual 4"
    annotation (Placement(transformation(extent={{-40, 110}, {-20, 130}})));

  UrdfSync.Visualizers.Box visual5(
    parameters = parameters.visual5,
    animation = animation)
    "Visual 5"
    annotation (Placement(transformation(extent={{-40, 140}, {-20, 160}})));

  UrdfSync.Visualizers.Box visual6(
    parameters = parameters.visual6,
    animation = animation)
    "Visual 6"
    annotation (Placement(transformation(extent={{-40, 170}, {-20, 190}})));

  UrdfSync.Visualizers.Box collision1(
    parameters = parameters.collision1,
    animation = showCollisions)
    "Collision 1"
    annotation (Placement(transformation(extent={{-40, -40}, {-20, -20}})));

  UrdfSync.Visualizers.Box collision2(
    parameters = parameters.collision2,
    animation = showCollisions)
    "Collision 2"
    annotation (Placement(transformation(extent={{-40, -70}, {-20, -50}})));

  UrdfSync.Contacts.Box contact1(
    parameters = parameters.collision1)
    "Ground contact of collision1"
    annotation (Placement(transformation(extent={{60, -40}, {80, -20}})));

  UrdfSync.Contacts.Box contact2(
    parameters = parameters.collision2)
    "Ground contact of collision2"
    annotation (Placement(transformation(extent={{60, -70}, {80, -50}})));

equation
  connect(frame_a, body.frame_a)
    annotation (Line(points={{-100, 0}, {-40, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, noBody.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 15}, {50, 15}, {50, 0}, {60, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual1.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 30}, {-40, 30}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual2.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 60}, {-40, 60}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual3.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 90}, {-40, 90}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual4.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 120}, {-40, 120}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual5.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 150}, {-40, 150}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual6.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 180}, {-40, 180}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, collision1.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, -30}, {-40, -30}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, collision2.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, -60}, {-40, -60}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, contact1.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, -15}, {50, -15}, {50, -30}, {60, -30}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, contact2.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, -45}, {50, -45}, {50, -60}, {60, -60}}, color={95, 95, 95}, thickness=0.5));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-130, -100}, {130, -70}}, textString="m=%{parameters.inertial.mass}")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 200}})),
    Documentation(info="<html>
<p>
Rigid body, visuals and collisions of the URDF link <code>base_link</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "ee359a99-9817", base = "7530e16dd5153aea"));
end Base_link;
