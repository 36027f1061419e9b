within Cart.Links;

model SwingAxis "Link \"swingAxis\""
  extends UrdfSync.Icons.Link;

  parameter SwingAxisParameters parameters
    "Numbers of the link"
    annotation (Placement(transformation(extent={{-100, 80}, {-80, 100}})));

  parameter Boolean animation = true
    "= true, if visuals are drawn"
    annotation (Dialog(tab="Animation"));

  parameter Boolean showCollisions = false
    "= true, if collision shapes are drawn, in pink"
    annotation (Dialog(tab="Animation"));

  final parameter Modelica.Units.SI.Mass m = parameters.inertial.mass
    "Mass";

  final parameter Modelica.Units.SI.MomentOfInertia I[3, 3](each min = -Modelica.Constants.inf) = UrdfSync.Functions.inertiaInLinkAxes(
    parameters.inertial.origin.rpy,
    {parameters.inertial.inertia.ixx,
     parameters.inertial.inertia.iyy,
     parameters.inertial.inertia.izz,
     parameters.inertial.inertia.ixy,
     parameters.inertial.inertia.ixz,
     parameters.inertial.inertia.iyz})
    "Inertia tensor about the centre of mass, resolved in frame_a";

  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a
    "Link frame"
    annotation (Placement(transformation(extent={{-116, -16}, {-84, 16}})));

  Modelica.Mechanics.MultiBody.Parts.Body body(
    animation = false,
    m = m,
    r_CM = parameters.inertial.origin.xyz,
    I_11 = I[1, 1],
    I_22 = I[2, 2],
    I_33 = I[3, 3],
    I_21 = I[2, 1],
    I_31 = I[3, 1],
    I_32 = I[3, 2])
    "Mass and inertia"
    annotation (Placement(transformation(extent={{-40, -10}, {-20, 10}})));

  UrdfSync.Visualizers.Box visual1(
    parameters = parameters.visual1,
    animation = animation)
    "Visual 1"
    annotation (Placement(transformation(extent={{-40, 20}, {-20, 40}})));

equation
  connect(frame_a, body.frame_a)
    annotation (Line(points={{-100, 0}, {-40, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(frame_a, visual1.frame_a)
    annotation (Line(points={{-100, 0}, {-60, 0}, {-60, 30}, {-40, 30}}, color={95, 95, 95}, thickness=0.5));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-150, -100}, {150, -70}}, textString="m=%{parameters.inertial.mass}")}),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}})),
    Documentation(info="<html>
<p>
Rigid body, visuals and collisions of the URDF link <code>swingAxis</code>. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end SwingAxis;
