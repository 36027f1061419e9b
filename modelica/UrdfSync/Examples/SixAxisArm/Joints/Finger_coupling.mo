within UrdfSync.Examples.SixAxisArm.Joints;

model Finger_coupling "Prismatic joint \"finger_coupling\" from link \"gripper_body\" to link \"finger_right\""
  extends UrdfSync.Icons.PrismaticJoint;
  extends UrdfSync.Interfaces.PartialPrismaticJoint(
    redeclare Finger_couplingParameters parameters);

  Modelica.Mechanics.MultiBody.Parts.FixedRotation origin(
    animation = false,
    r = parameters.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.origin.rpy[3], parameters.origin.rpy[2], parameters.origin.rpy[1]}))
    "From the frame of the parent link to the joint frame"
    annotation (Placement(transformation(extent={{-80, -10}, {-60, 10}})));

  Modelica.Mechanics.MultiBody.Joints.Prismatic prismatic(
    animation = false,
    useAxisFlange = true,
    n = parameters.axis,
    stateSelect = stateSelect,
    s(start = s_start, fixed = fixedStart),
    v(start = v_start, fixed = fixedStart))
    "Motion along the axis"
    annotation (Placement(transformation(extent={{0, -10}, {20, 10}})));

  replaceable model FrictionLaw = UrdfSync.Friction.Translational
    constrainedby UrdfSync.Friction.PartialTranslational
    "Law of damping and dry friction"
    annotation (choicesAllMatching=true);

  FrictionLaw friction(parameters = parameters.dynamics)
    "Damping and dry friction"
    annotation (Placement(transformation(extent={{0, 30}, {20, 50}})));

equation
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(parameters.limits.lower, prismatic.s)),
    getInstanceName() + " (joint " + parameters.name + ") is below its lower position limit", AssertionLevel.warning);
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(prismatic.s, parameters.limits.upper)),
    getInstanceName() + " (joint " + parameters.name + ") is above its upper position limit", AssertionLevel.warning);
  assert(noEvent(not checkLimits or UrdfSync.Functions.isAtMost(abs(prismatic.v), parameters.limits.velocity)),
    getInstanceName() + " (joint " + parameters.name + ") is faster than its velocity limit", AssertionLevel.warning);
  assert(noEvent(not (checkLimits and checkEffort) or UrdfSync.Functions.isAtMost(abs(axis.f), parameters.limits.effort)),
    getInstanceName() + " (joint " + parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  connect(frame_a, origin.frame_a)
    annotation (Line(points={{-100, 0}, {-80, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(origin.frame_b, prismatic.frame_a)
    annotation (Line(points={{-60, 0}, {0, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(prismatic.frame_b, frame_b)
    annotation (Line(points={{20, 0}, {100, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(prismatic.axis, axis)
    annotation (Line(points={{18, 6}, {40, 6}, {40, 70}, {0, 70}, {0, 100}}, color={0, 127, 0}));
  connect(prismatic.support, support)
    annotation (Line(points={{6, 6}, {6, 20}, {-60, 20}, {-60, 100}}, color={0, 127, 0}));
  connect(prismatic.support, friction.flange_a)
    annotation (Line(points={{6, 6}, {6, 20}, {-14, 20}, {-14, 40}, {0, 40}}, color={0, 127, 0}));
  connect(prismatic.axis, friction.flange_b)
    annotation (Line(points={{18, 6}, {40, 6}, {40, 40}, {20, 40}}, color={0, 127, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-130, -100}, {130, -70}}, textString="n=%{parameters.axis}")}),
    Documentation(info="<html>
<p>
The URDF joint <code>finger_coupling</code>: link <code>finger_right</code> relative to link <code>gripper_body</code> slides within its limits. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "2301de4d-1e0d", base = "e567068a844ecbc6"));
end Finger_coupling;
