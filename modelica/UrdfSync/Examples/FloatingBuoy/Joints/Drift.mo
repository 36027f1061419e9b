within UrdfSync.Examples.FloatingBuoy.Joints;

model Drift "Floating joint \"drift\" from link \"world\" to link \"buoy\""
  extends UrdfSync.Icons.FloatingJoint;
  extends UrdfSync.Interfaces.PartialFloatingJoint(
    redeclare DriftParameters parameters);

  Modelica.Mechanics.MultiBody.Parts.FixedRotation origin(
    animation = false,
    r = parameters.origin.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({parameters.origin.rpy[3], parameters.origin.rpy[2], parameters.origin.rpy[1]}))
    "From the frame of the parent link to the joint frame"
    annotation (Placement(transformation(extent={{-80, -10}, {-60, 10}})));

  UrdfSync.Robots.FreeBase freeMotion(
    fixedStart = fixedStart,
    r_start = r_start,
    rpy_start = rpy_start,
    v_start = v_start,
    w_start = w_start)
    "Six degrees of freedom"
    annotation (Placement(transformation(extent={{0, -10}, {20, 10}})));

equation
  connect(frame_a, origin.frame_a)
    annotation (Line(points={{-100, 0}, {-80, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(origin.frame_b, freeMotion.frame_a)
    annotation (Line(points={{-60, 0}, {0, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(freeMotion.frame_b, frame_b)
    annotation (Line(points={{20, 0}, {100, 0}}, color={95, 95, 95}, thickness=0.5));

  annotation (Documentation(info="<html>
<p>
The URDF joint <code>drift</code>: link <code>buoy</code> relative to link <code>world</code> moves freely. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"),
    __urdfsync(id = "1428f346-6ce9", base = "eb58b2e4da5d890c"));
end Drift;
