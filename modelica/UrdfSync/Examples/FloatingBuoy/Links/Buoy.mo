within UrdfSync.Examples.FloatingBuoy.Links;

model Buoy "Link \"buoy\""
  extends UrdfSync.Icons.Link;
  extends UrdfSync.Interfaces.PartialLink(
    redeclare BuoyParameters parameters);

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

  UrdfSync.Visualizers.Cylinder visual1(
    parameters = parameters.visual1,
    animation = animation)
    "Visual 1"
    annotation (Placement(transformation(extent={{-40, 20}, {-20, 40}})));

  UrdfSync.Visualizers.Cylinder visual2(
    parameters = parameters.visual2,
    animation = animation)
    "Visual 2"
    annotation (Placement(transformation(extent={{-40, 50}, {-20, 70}})));

  UrdfSync.Visualizers.Sphere visual3(
    parameters = parameters.visual3,
    animation = animation)
    "Visual 3"
    annotation (Placement(transformation(extent={{-40, 80}, {-20, 100}})));

  UrdfSync.Visualizers.Box visual4(
    parameters = parameters.visual4,
    animation = animation)
    "Visual 4"
    annotation (Placement(transformation(extent={{-40, 110}, {-20, 130}})));

  UrdfSync.Visualizers.Cylinder visual5(
    parameters = parameters.visual5,
    animation = animation)
    "Visual 5"
    annotation (Placement(transformation(extent={{-40, 140}, {-20, 160}})));

  UrdfSync.Visualizers.Cylinder visual6(
    parameters = parameters.visual6,
    animation = animation)
    "Visual 6"
    annotation (Placement(transformation(extent={{-40, 170}, {-20, 190}})));

  UrdfSync.Visualizers.Cylinder visual7(
    parameters = parameters.visual7,
    animation = animation)
    "Visual 7"
    annotation (Placement(transformation(extent={{-40, 200}, {-20, 220}})));

  UrdfSync.Visualizers.Cylinder visual8(
    parameters = parameters.visual8,
    animation = animation)
    "Visual 8"
    annotation (Placement(transformation(extent={{-40, 230}, {-20, 250}})));

  UrdfSync.Visualizers.Cylinder visual9(
    parameters = parameters.visual9,
    animation = animation)
    "Visual 9"
    annotation (Placement(transformation(extent={{-40, 260}, {-20, 280}})));

  UrdfSync.Visualizers.Sphere visual10(
    parameters = parameters.visual10,
    animation = animation)
    "Visual 10"
    annotation (Placement(transformation(extent={{-40, 290}, {-20, 310}})));

  UrdfSync.Visualizers.Cylinder collision1(
    parameters = parameters.collision1,
    animation = showCollisions)
    "Collision 1"
    annotation (Placement(transformation(extent={{-40, -40}, {-20, -20}})));

  UrdfSync.Visualizers.Sphere collision2(
    parameters = parameters.collision2,
    animation = showCollisions)
    "Collision 2"
    annotation (Placement(transformation(extent={{-40, -70}, {-20, -50}})));

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
  connect(frame_a, visual7.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 210}, {-40, 210}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual8.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 240}, {-40, 240}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual9.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 270}, {-40, 270}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual10.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 300}, {-40, 300}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, collision1.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, -30}, {-40, -30}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, collision2.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, -60}, {-40, -60}}, color={95, 95, 95}, thickness=0.5));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-130, -100}, {130, -70}}, textString="m=%{parameters.inertial.mass}")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 320}})),
    Documentation(info="<html>
<p>
Rigid body, visuals and collisions of the URDF link <code>buoy</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "aeb4b8f9-9817", base = "fe4729dfb2a10474"));
end Buoy;
