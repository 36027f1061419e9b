within UrdfSync.Examples.FourBar.Joints;

model Rocker_pin "Revolute joint \"rocker_pin\" that closes a loop from link \"coupler\" to link \"rocker\""
  extends UrdfSync.Icons.Loop;
  extends UrdfSync.Interfaces.PartialLoop(
    redeclare Rocker_pinParameters parameters);

  Modelica.Mechanics.MultiBody.Parts.FixedRotation origin(
    animation = false,
    r = parameters.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.origin.rpy[3], parameters.origin.rpy[2], parameters.origin.rpy[1]}))
    "From the frame of the parent link to the joint frame"
    annotation (Placement(transformation(extent={{-80, -10}, {-60, 10}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation childOrigin(
    animation = false,
    r = parameters.childOrigin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.childOrigin.rpy[3], parameters.childOrigin.rpy[2], parameters.childOrigin.rpy[1]}))
    "From the frame of the child link to its frame of the joint"
    annotation (Placement(transformation(extent={{80, -10}, {60, 10}})));

  UrdfSync.Loops.Constraint constraint(
    translations = parameters.translations,
    rotations = parameters.rotations,
    childRotations = parameters.childRotations)
    "Holds the two frames of the joint together"
    annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));

equation
  gap = constraint.gap;
  f = constraint.f;
  t = constraint.t;
  connect(frame_a, origin.frame_a)
    annotation (Line(points={{-100, 0}, {-80, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(origin.frame_b, constraint.frame_a)
    annotation (Line(points={{-60, 0}, {-10, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(constraint.frame_b, childOrigin.frame_b)
    annotation (Line(points={{10, 0}, {60, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(childOrigin.frame_a, frame_b)
    annotation (Line(points={{80, 0}, {100, 0}}, color={95, 95, 95}, thickness=0.5));

  annotation (Documentation(info="<html>
<p>
The loop <code>rocker_pin</code>: a frame of link <code>rocker</code> at a frame of link <code>coupler</code>, as a revolute joint holds it. The loop is planar: two equations in its plane close it. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "c430855c-c662", base = "e0141e467201a3e6"));
end Rocker_pin;
