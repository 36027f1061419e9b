within UrdfSync.Examples.WheeledRobot.Joints;

model Mast_mount "Fixed joint \"mast_mount\" from link \"base_link\" to link \"lidar_mast\""
  extends UrdfSync.Icons.FixedJoint;
  extends UrdfSync.Interfaces.PartialFixedJoint(
    redeclare Mast_mountParameters parameters);

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
The URDF joint <code>mast_mount</code>: link <code>lidar_mast</code> relative to link <code>base_link</code> does not move. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "ef89457d-d5bf", base = "8bd5c9317adeeb26"));
end Mast_mount;
