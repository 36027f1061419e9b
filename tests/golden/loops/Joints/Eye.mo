within Zoo.Mill.Joints;

model Eye "Ball joint \"eye\" from link \"bob\" to link \"ring\""
  extends UrdfSync.Icons.BallJoint;
  extends UrdfSync.Interfaces.PartialBallJoint(
    redeclare EyeParameters parameters);

  Modelica.Mechanics.MultiBody.Parts.FixedRotation origin(
    animation = false,
    r = parameters.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.origin.rpy[3], parameters.origin.rpy[2], parameters.origin.rpy[1]}))
    "From the frame of the parent link to the joint frame"
    annotation (Placement(transformation(extent={{-80, -10}, {-60, 10}})));

  Modelica.Mechanics.MultiBody.Joints.Spherical spherical(
    animation = false,
    enforceStates = hasStates,
    angles_fixed = fixedStart and hasStates,
    sequence_start = {3, 2, 1},
    angles_start = {rpy_start[3], rpy_start[2], rpy_start[1]},
    w_rel_a_fixed = fixedStart and hasStates,
    w_rel_a_start = w_start)
    "Three degrees of freedom"
    annotation (Placement(transformation(extent={{0, -10}, {20, 10}})));

equation
  connect(frame_a, origin.frame_a)
    annotation (Line(points={{-100, 0}, {-80, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(origin.frame_b, spherical.frame_a)
    annotation (Line(points={{-60, 0}, {0, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(spherical.frame_b, frame_b)
    annotation (Line(points={{20, 0}, {100, 0}}, color={95, 95, 95}, thickness=0.5));

  annotation (Documentation(info="<html>
<p>
The URDF joint <code>eye</code>: link <code>ring</code> relative to link <code>bob</code> turns in all directions. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end Eye;
