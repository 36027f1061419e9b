within UrdfSync.Examples.SixAxisArm.Joints;

model Flange_to_tool "Fixed joint \"flange_to_tool\" from link \"mounting_flange\" to link \"tool0\""
  extends UrdfSync.Icons.FixedJoint;
  extends UrdfSync.Interfaces.PartialFixedJoint(
    redeclare Flange_to_toolParameters parameters);

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
The URDF joint <code>flange_to_tool</code>: link <code>tool0</code> relative to link <code>mounting_flange</code> does not move. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "95f1384f-d5bf", base = "f138ce8f5c220910"));
end Flange_to_tool;
