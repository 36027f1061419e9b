within UrdfSync.Examples.WheeledRobot.Joints;

model Camera_mount "Fixed joint \"camera_mount\" from link \"head\" to link \"camera_optical_frame\""
  extends UrdfSync.Icons.FixedJoint;
  extends UrdfSync.Interfaces.PartialFixedJoint(
    redeclare Camera_mountParameters parameters);

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
The URDF joint <code>camera_mount</code>: link <code>camera_optical_frame</code> relative to link <code>head</code> does not move. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "33a8b7a3-d5bf", base = "9d4aade95d57179c"));
end Camera_mount;
