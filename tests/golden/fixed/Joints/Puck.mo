within Zoo.Menagerie.Joints;

model Puck "Planar joint \"puck\" from link \"table\" to link \"a\"b\\ <c> & << 1/0 >> {{d}} %e\""
  extends UrdfSync.Icons.PlanarJoint;
  extends UrdfSync.Interfaces.PartialPlanarJoint(
    redeclare PuckParameters parameters);

  final parameter Real n_x[3](each unit = "1") = UrdfSync.Functions.normalTo(parameters.axis)
    "First sliding direction, resolved in the joint frame";

  Modelica.Mechanics.MultiBody.Parts.FixedRotation origin(
    animation = false,
    r = parameters.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.origin.rpy[3], parameters.origin.rpy[2], parameters.origin.rpy[1]}))
    "From the frame of the parent link to the joint frame"
    annotation (Placement(transformation(extent={{-80, -10}, {-60, 10}})));

  Modelica.Mechanics.MultiBody.Joints.Prismatic prismatic_x(
    animation = false,
    useAxisFlange = false,
    n = n_x,
    stateSelect = StateSelect.prefer,
    s(start = s_start[1], fixed = fixedStart),
    v(start = v_start[1], fixed = fixedStart))
    "Motion along n_x"
    annotation (Placement(transformation(extent={{-40, -10}, {-20, 10}})));

  Modelica.Mechanics.MultiBody.Joints.Prismatic prismatic_y(
    animation = false,
    useAxisFlange = false,
    n = cross(parameters.axis, n_x),
    stateSelect = StateSelect.prefer,
    s(start = s_start[2], fixed = fixedStart),
    v(start = v_start[2], fixed = fixedStart))
    "Motion at right angles to n_x"
    annotation (Placement(transformation(extent={{0, -10}, {20, 10}})));

  Modelica.Mechanics.MultiBody.Joints.Revolute revolute(
    animation = false,
    useAxisFlange = false,
    n = parameters.axis,
    stateSelect = StateSelect.prefer,
    phi(start = phi_start, fixed = fixedStart),
    w(start = w_start, fixed = fixedStart))
    "Turn about the normal of the plane"
    annotation (Placement(transformation(extent={{40, -10}, {60, 10}})));

equation
  connect(frame_a, origin.frame_a)
    annotation (Line(points={{-100, 0}, {-80, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(origin.frame_b, prismatic_x.frame_a)
    annotation (Line(points={{-60, 0}, {-40, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(prismatic_x.frame_b, prismatic_y.frame_a)
    annotation (Line(points={{-20, 0}, {0, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(prismatic_y.frame_b, revolute.frame_a)
    annotation (Line(points={{20, 0}, {40, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(revolute.frame_b, frame_b)
    annotation (Line(points={{60, 0}, {100, 0}}, color={95, 95, 95}, thickness=0.5));

  annotation (Documentation(info="<html>
<p>
The URDF joint <code>puck</code>: link <code>a&quot;b\\ &lt;c&gt; &amp; &lt;&lt; 1/0 &gt;&gt; {{d}} %e</code> relative to link <code>table</code> slides in a plane and turns about its normal. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end Puck;
