within UrdfSync.Sensors;

partial model PartialSensor "What sensors on a link have in common"

  parameter UrdfSync.Records.Origin place
    "Place of the sensor in the frame of the link"
    annotation (Placement(transformation(extent={{-70, 80}, {-50, 100}})));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a
    "Frame of the link that carries the sensor"
    annotation (Placement(transformation(extent={{-116, -16}, {-84, 16}})));

  Modelica.Mechanics.MultiBody.Parts.FixedRotation origin(
    animation = false,
    r = place.xyz,
    rotationType = Modelica.Mechanics.MultiBody.Types.RotationTypes.PlanarRotationSequence,
    sequence = {3, 2, 1},
    angles = Modelica.Units.Conversions.to_deg({place.rpy[3], place.rpy[2], place.rpy[1]}))
    "From the frame of the link to that of the sensor"
    annotation (Placement(transformation(extent={{-70, -10}, {-50, 10}})));

equation
  connect(frame_a, origin.frame_a)
    annotation (Line(points={{-100, 0}, {-70, 0}}, color={95, 95, 95}, thickness=0.5));

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-150, 80}, {150, 120}}, textColor={0, 0, 255}, textString="%name"),
      Line(points={{-70, 0}, {-100, 0}}, color={95, 95, 95})}),
    Documentation(info="<html>
<p>
A sensor is fixed to a link: <code>origin.frame_b</code> is its own frame.
</p>
</html>"));
end PartialSensor;
