within Arm.Links;

model Upper "Link \"upper\""
  extends UrdfSync.Icons.Link;
  extends UrdfSync.Interfaces.PartialLink(
    redeclare UpperParameters parameters);

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

equation
  connect(frame_a, body.frame_a)
    annotation (Line(points={{-100, 0}, {-40, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, noBody.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 15}, {50, 15}, {50, 0}, {60, 0}}, color={95, 95, 95}, thickness=0.5));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-130, -100}, {130, -70}}, textString="m=%{parameters.inertial.mass}")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}})),
    Documentation(info="<html>
<p>
Rigid body, visuals and collisions of the URDF link <code>upper</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "c7d169ad-9817", base = "a01a95321a6b5f85"));
// mine
end Upper;
