within Arm.Joints;

model Swing "Revolute joint \"swing\" from link \"base\" to link \"boom\""
  extends UrdfSync.Icons.RevoluteJoint;
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;

  parameter SwingParameters parameters
    "Numbers of the joint"
    annotation (Placement(transformation(extent={{-100, 80}, {-80, 100}})));

  parameter Integer axisNumber = 0
    "Number of the axis in the robot's vector of flanges; 0 if it has none";

  parameter Boolean checkLimits = true
    "= true, if passing a limit is reported by a warning";

  parameter Boolean checkEffort = true
    "= true, if the effort at axis is checked, too; = false, if axis is not all that drives the joint";

  parameter StateSelect stateSelect = StateSelect.prefer
    "Whether position and speed are taken as states"
    annotation (Dialog(tab="Advanced"));

  parameter Boolean fixedStart = true
    "= true, if the simulation begins at the start values; = false, if they are guesses"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Angle phi_start = 0
    "Start value of the position"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.AngularVelocity w_start = 0
    "Start value of the speed"
    annotation (Dialog(tab="Initialization"));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a axis
    "Drive"
    annotation (Placement(transformation(extent={{-10, 90}, {10, 110}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b support
    "Housing of the drive"
    annotation (Placement(transformation(extent={{-70, 90}, {-50, 110}})));

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

  UrdfSync.Friction.Rotational friction(parameters = parameters.dynamics)
    "Damping and dry friction"
    annotation (Placement(transformation(extent={{0, 30}, {20, 50}})));

equation
  assert(not checkLimits or revolute.phi >= parameters.limits.lower - 1e-6,
    getInstanceName() + " (joint " + parameters.name + ") is below its lower position limit", AssertionLevel.warning);
  assert(not checkLimits or revolute.phi <= parameters.limits.upper + 1e-6,
    getInstanceName() + " (joint " + parameters.name + ") is above its upper position limit", AssertionLevel.warning);
  assert(not checkLimits or 0.999999*abs(revolute.w) <= parameters.limits.velocity + 1e-6,
    getInstanceName() + " (joint " + parameters.name + ") is faster than its velocity limit", AssertionLevel.warning);
  assert(not (checkLimits and checkEffort) or 0.999999*abs(axis.tau) <= parameters.limits.effort + 1e-6,
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
  connect(revolute.support, friction.flange_a)
    annotation (Line(points={{4, 10}, {4, 20}, {-14, 20}, {-14, 40}, {0, 40}}, color={0, 0, 0}));
  connect(revolute.axis, friction.flange_b)
    annotation (Line(points={{10, 10}, {10, 20}, {40, 20}, {40, 40}, {20, 40}}, color={0, 0, 0}));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-150, -100}, {150, -70}}, textString="%axisNumber: n=%{parameters.axis}")}),
    Documentation(info="<html>
<p>
The URDF joint <code>swing</code>: link <code>boom</code> relative to link <code>base</code> turns within its limits. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end Swing;
