within UrdfSync.Examples.WheeledRobot.Joints;

model Guide_mount "Fixed joint \"guide_mount\" from link \"base_link\" to link \"column_guide\""
  extends UrdfSync.Icons.FixedJoint;
  extends UrdfSync.Interfaces.PartialFixedJoint(
    redeclare Guide_mountParameters parameters);

  Modelica.Mechanics.MultiBody.Parts.FixedRotation origin(
    animation = false,
    r = parameters.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.origin.rpy[3], parameters.origin.rpy[2], parameters.origin.rpy[1]}))
    "From the frame of the parent link to the joint frame"
    annotation (Placement(transformation(extent={{-80, -10}, {-60, 10}})));

equation
  connect(frame_a, origin.frame_a)
    annotation (Line(points={{-100, 0}, {-80, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(origin.frame_b, frame_b)
    annotation (Line(points={{-60, 0}, {100, 0}}, color={95, 95, 95}, thickness=0.5));

  annotation (Documentation(info="<html>
<p>
The URDF joint <code>guide_mount</code>: link <code>column_guide</code> relative to link <code>base_link</code> does not move. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "b4b6837d-d5bf", base = "1ca918b57a5d96b3"));
end Guide_mount;
