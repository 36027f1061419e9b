within Arm.Joints;

model Elbow "Continuous joint \"elbow\" from link \"upper\" to link \"fore\""
  extends UrdfSync.Icons.ContinuousJoint;
  extends UrdfSync.Interfaces.PartialRevoluteJoint(
    redeclare ElbowParameters parameters,
    phi_min = -Modelica.Constants.inf,
    phi_max = Modelica.Constants.inf);

  Modelica.Mechanics.MultiBody.Parts.FixedRotation origin(
    animation = false,
    r = parameters.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.origin.rpy[3], parameters.origin.rpy[2], parameters.origin.rpy[1]}))
    "From the frame of the parent link to the joint frame"
    annotation (Placement(transformation(extent={{-80, -10}, {-60, 10}})));

  Modelica.Mechanics.MultiBody.Joints.Revolute revolute(
    animation = false,
    useAxisFlange = true,
    n = parameters.axis,
    stateSelect = stateSelect,
    phi(start = phi_start, fixed = fixedStart),
    w(start = w_start, fixed = fixedStart))
    "Motion along the axis"
    annotation (Placement(transformation(extent={{0, -10}, {20, 10}})));

equation
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(revolute.w), parameters.limits.velocity)),
    getInstanceName() + " (joint " + parameters.name + ") is faster than its velocity limit", AssertionLevel.warning);
  assert(noEvent(not (checkLimits and checkEffort) or UrdfSync.Functions.isAtMost(abs(axis.tau), parameters.limits.effort)),
    getInstanceName() + " (joint " + parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  connect(frame_a, origin.frame_a)
    annotation (Line(points={{-100, 0}, {-80, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(origin.frame_b, revolute.frame_a)
    annotation (Line(points={{-60, 0}, {0, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(revolute.frame_b, frame_b)
    annotation (Line(points={{20, 0}, {100, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(revolute.axis, axis)
    annotation (Line(points={{10, 10}, {10, 20}, {40, 20}, {40, 70}, {0, 70}, {0, 100}}, color={0, 0, 0}));
  connect(revolute.support, support)
    annotation (Line(points={{4, 10}, {4, 20}, {-60, 20}, {-60, 100}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-130, -100}, {130, -70}}, textString="n=%{parameters.axis}")}),
    Documentation(info="<html>
<p>
The URDF joint <code>elbow</code>: link <code>fore</code> relative to link <code>upper</code> turns without end stops. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "056fd1cc-1e0d", base = "599ae9fbbe51fe07"));
end Elbow;
