within UrdfSync.Examples.CustomArm;

model GearedTurret "Turret with a gear and the rotor of its motor"
  extends UrdfSync.Icons.RevoluteJoint;
  extends UrdfSync.Interfaces.PartialRevoluteJoint(
    redeclare UrdfSync.Examples.SixAxisArm.Joints.TurretParameters parameters);

  parameter Real ratio(unit = "1") = 120
    "Turns of the rotor for one turn of the joint";

  parameter Modelica.Units.SI.Inertia J_rotor = 2e-4
    "Inertia of the rotor, on its own side of the gear";

  Modelica.Units.SI.Torque tau_motor = axis.tau/ratio
    "Torque of the motor, on its own side of the gear";

  UrdfSync.Examples.SixAxisArm.Joints.Turret joint(
    parameters = parameters,
    checkLimits = checkLimits,
    checkEffort = false,
    stateSelect = stateSelect,
    phi_start = phi_start,
    w_start = w_start,
    fixedStart = fixedStart)
    "The generated joint: geometry, friction and limits"
    annotation (Placement(transformation(extent={{30, -10}, {50, 10}})));

  Modelica.Mechanics.Rotational.Components.IdealGear gear(
    useSupport = true,
    ratio = ratio)
    "Gear without losses: those are in the friction of the joint"
    annotation (Placement(transformation(extent={{0, 40}, {20, 60}})));

  Modelica.Mechanics.Rotational.Components.Inertia rotor(J = J_rotor)
    "Rotor of the motor"
    annotation (Placement(transformation(extent={{-40, 40}, {-20, 60}})));

equation
  assert(noEvent(not (checkLimits and checkEffort) or UrdfSync.Functions.isAtMost(abs(axis.tau), parameters.limits.effort)),
    getInstanceName() + " (joint " + parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  connect(frame_a, joint.frame_a)
    annotation (Line(points={{-100, 0}, {30, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(joint.frame_b, frame_b)
    annotation (Line(points={{50, 0}, {100, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(rotor.flange_b, gear.flange_a)
    annotation (Line(points={{-20, 50}, {0, 50}}, color={0, 0, 0}));
  connect(gear.flange_b, joint.axis)
    annotation (Line(points={{20, 50}, {40, 50}, {40, 10}}, color={0, 0, 0}));
  connect(axis, joint.axis)
    annotation (Line(points={{0, 100}, {0, 76}, {40, 76}, {40, 10}}, color={0, 0, 0}));
  connect(support, joint.support)
    annotation (Line(points={{-60, 100}, {-60, 24}, {34, 24}, {34, 10}}, color={0, 0, 0}));
  connect(gear.support, joint.support)
    annotation (Line(points={{10, 40}, {10, 24}, {34, 24}, {34, 10}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-130, -100}, {130, -70}}, textString="ratio=%ratio")}),
    Documentation(info="<html>
<p>
<code>axis</code> stays on the joint's side of the gear, so that positions and limits keep their meaning. The rotor turns <code>ratio</code> times as fast and adds
<code>J_rotor*ratio^2</code> to the inertia that the drive feels. The gear is rigid: the joint has the states that it had.
</p>
<p>
The rotor is a part of one dimension: torques by which it resists a turn of its own axis in space are left out. <code>Rotor1D</code> of the standard library
has them.
</p>
</html>"));
end GearedTurret;
