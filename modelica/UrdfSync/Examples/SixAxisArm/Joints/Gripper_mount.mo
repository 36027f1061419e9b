within UrdfSync.Examples.SixAxisArm.Joints;

model Gripper_mount "Fixed joint \"gripper_mount\" from link \"tool0\" to link \"gripper_body\""
  extends UrdfSync.Icons.FixedJoint;
  extends UrdfSync.Interfaces.PartialFixedJoint(
    redeclare Gripper_mountParameters parameters);

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
The URDF joint <code>gripper_mount</code>: link <code>gripper_body</code> relative to link <code>tool0</code> does not move. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "b3f890c5-d5bf", base = "27ee3f81c2d3c568"));
end Gripper_mount;
