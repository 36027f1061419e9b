within UrdfSync.Drives;

model RotationalPositionServo "Pushes a turning joint towards a commanded position"
  extends UrdfSync.Drives.PartialRotationalServo;

  Modelica.Blocks.Interfaces.RealInput phi_ref(unit = "rad")
    "Where the joint is to go"
    annotation (Placement(transformation(extent={{-140, -20}, {-100, 20}})));

equation
  tau_asked = parameters.positionGain*(UrdfSync.Functions.limited(phi_ref, parameters.minPosition, parameters.maxPosition) - phi) - parameters.velocityGain*w;

  annotation (Documentation(info="<html>
<pre>
tau = positionGain*(phi_ref - phi) - velocityGain*w
</pre>
<p>
The command is kept between <code>minPosition</code> and <code>maxPosition</code>. Under a load, the joint stays beside the command.
</p>
</html>"));
end RotationalPositionServo;
