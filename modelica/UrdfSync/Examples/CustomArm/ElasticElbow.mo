within UrdfSync.Examples.CustomArm;

model ElasticElbow "Elbow whose gear gives way between the motor and the arm"
  extends UrdfSync.Icons.RevoluteJoint;
  extends UrdfSync.Interfaces.PartialRevoluteJoint(
    redeclare UrdfSync.Examples.SixAxisArm.Joints.ElbowParameters parameters);

  parameter Modelica.Units.SI.Inertia J_motor = 0.6
    "Inertia of motor and gear, as it acts on the joint's side of the gear";

  parameter Modelica.Units.SI.RotationalSpringConstant c = 2e4
    "Stiffness of the gear";

  parameter Modelica.Units.SI.RotationalDampingConstant d = 40
    "Damping of the gear";

  parameter Modelica.Units.SI.Angle phi_elastic_start = 0
    "Start value of phi_elastic: zero, if the gear is relaxed"
    annotation (Dialog(tab="Initialization"));

  Modelica.Units.SI.Angle phi_elastic = gear.phi_rel
    "How far the arm is ahead of the motor";

  UrdfSync.Examples.SixAxisArm.Joints.Elbow joint(
    parameters = parameters,
    checkLimits = checkLimits,
    checkEffort = false,
    stateSelect = stateSelect,
    phi_start = phi_start + phi_elastic_start,
    w_start = w_start,
    fixedStart = true)
    "The generated joint: geometry, friction and limits"
    annotation (Placement(transformation(extent={{30, -10}, {50, 10}})));

  Modelica.Mechanics.Rotational.Components.Inertia motor(
    J = J_motor,
    phi(start = phi_start, fixed = fixedStart),
    w(start = w_start, fixed = fixedStart))
    "Motor and gear"
    annotation (Placement(transformation(extent={{-40, 40}, {-20, 60}})));

  Modelica.Mechanics.Rotational.Components.SpringDamper gear(
    c = c,
    d = d)
    "Elasticity of the gear"
    annotation (Placement(transformation(extent={{0, 40}, {20, 60}})));

equation
  assert(noEvent(not (checkLimits and checkEffort) or UrdfSync.Functions.isAtMost(abs(axis.tau), parameters.limits.effort)),
    getInstanceName() + " (joint " + parameters.name + ") is driven above its effort limit", AssertionLevel.warning);
  connect(frame_a, joint.frame_a)
    annotation (Line(points={{-100, 0}, {30, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(joint.frame_b, frame_b)
    annotation (Line(points={{50, 0}, {100, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(axis, motor.flange_a)
    annotation (Line(points={{0, 100}, {0, 76}, {-50, 76}, {-50, 50}, {-40, 50}}, color={0, 0, 0}));
  connect(motor.flange_b, gear.flange_a)
    annotation (Line(points={{-20, 50}, {0, 50}}, color={0, 0, 0}));
  connect(gear.flange_b, joint.axis)
    annotation (Line(points={{20, 50}, {40, 50}, {40, 10}}, color={0, 0, 0}));
  connect(support, joint.support)
    annotation (Line(points={{-60, 100}, {-60, 24}, {34, 24}, {34, 10}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-130, -100}, {130, -70}}, textString="c=%c")}),
    Documentation(info="<html>
<p>
The drive turns the motor; a spring and a damper lead from the motor to the joint. <code>axis</code> is now the motor, on the joint's side of the gear, so that
its position and its limits mean what they mean without the spring.
</p>
<p>
The arm swings against the motor: it has a position and a speed of its own, even where the position of <code>axis</code> is prescribed. So the
start values of <code>joint</code> are always fixed, those of <code>motor</code> only with <code>fixedStart</code>. With <code>phi_elastic_start = 0</code> the arm
begins with the spring relaxed, and sags within the first tenths of a second.
</p>
</html>"));
end ElasticElbow;
