within UrdfSync.Examples.PlanarPlatform.Joints;

model Glide "Planar joint \"glide\" from link \"world\" to link \"platform\""
  extends UrdfSync.Icons.PlanarJoint;
  extends UrdfSync.Interfaces.PartialPlanarJoint(
    redeclare GlideParameters parameters);

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
    useAxisFlange = true,
    n = n_x,
    stateSelect = StateSelect.prefer,
    s(start = s_start[1], fixed = fixedStart),
    v(start = v_start[1], fixed = fixedStart))
    "Motion along n_x"
    annotation (Placement(transformation(extent={{-40, -10}, {-20, 10}})));

  Modelica.Mechanics.MultiBody.Joints.Prismatic prismatic_y(
    animation = false,
    useAxisFlange = true,
    n = cross(parameters.axis, n_x),
    stateSelect = StateSelect.prefer,
    s(start = s_start[2], fixed = fixedStart),
    v(start = v_start[2], fixed = fixedStart))
    "Motion at right angles to n_x"
    annotation (Placement(transformation(extent={{0, -10}, {20, 10}})));

  Modelica.Mechanics.MultiBody.Joints.Revolute revolute(
    animation = false,
    useAxisFlange = true,
    n = parameters.axis,
    stateSelect = StateSelect.prefer,
    phi(start = phi_start, fixed = fixedStart),
    w(start = w_start, fixed = fixedStart))
    "Turn about the normal of the plane"
    annotation (Placement(transformation(extent={{40, -10}, {60, 10}})));

  UrdfSync.Friction.Translational friction_x(parameters = parameters.translation)
    "Losses of the motion along n_x"
    annotation (Placement(transformation(extent={{-40, 30}, {-20, 50}})));

  UrdfSync.Friction.Translational friction_y(parameters = parameters.translation)
    "Losses of the motion at right angles to n_x"
    annotation (Placement(transformation(extent={{0, 30}, {20, 50}})));

  UrdfSync.Friction.Rotational friction(parameters = parameters.rotation)
    "Losses of the turn"
    annotation (Placement(transformation(extent={{40, 30}, {60, 50}})));

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
  connect(prismatic_x.support, friction_x.flange_a)
    annotation (Line(points={{-34, 6}, {-34, 20}, {-46, 20}, {-46, 40}, {-40, 40}}, color={0, 127, 0}));
  connect(prismatic_x.axis, friction_x.flange_b)
    annotation (Line(points={{-22, 6}, {-22, 20}, {-14, 20}, {-14, 40}, {-20, 40}}, color={0, 127, 0}));
  connect(prismatic_y.support, friction_y.flange_a)
    annotation (Line(points={{6, 6}, {6, 20}, {-6, 20}, {-6, 40}, {0, 40}}, color={0, 127, 0}));
  connect(prismatic_y.axis, friction_y.flange_b)
    annotation (Line(points={{18, 6}, {18, 20}, {26, 20}, {26, 40}, {20, 40}}, color={0, 127, 0}));
  connect(revolute.support, friction.flange_a)
    annotation (Line(points={{44, 10}, {44, 20}, {34, 20}, {34, 40}, {40, 40}}, color={0, 0, 0}));
  connect(revolute.axis, friction.flange_b)
    annotation (Line(points={{50, 10}, {50, 20}, {66, 20}, {66, 40}, {60, 40}}, color={0, 0, 0}));

  annotation (Documentation(info="<html>
<p>
The URDF joint <code>glide</code>: link <code>platform</code> relative to link <code>world</code> slides in a plane and turns about its normal. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "5cea8f3f-9f4f", base = "9991d48a5a4f2eab"));
end Glide;
