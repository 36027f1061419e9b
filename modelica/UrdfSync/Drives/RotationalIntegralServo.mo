within UrdfSync.Drives;

model RotationalIntegralServo "Pushes a turning joint towards the integral of a commanded speed"
  extends UrdfSync.Drives.PartialRotationalServo;

  parameter Modelica.Units.SI.Angle phi_start = 0
    "Reference at the beginning";

  Modelica.Blocks.Interfaces.RealInput w_ref(unit = "rad/s")
    "How fast the reference is to go"
    annotation (Placement(transformation(extent={{-140, -20}, {-100, 20}})));

  Modelica.Units.SI.Angle phi_ref(start = phi_start, fixed = true)
    "Reference: where the joint is to go";

  Modelica.Units.SI.AngularVelocity w_limited
    "Commanded speed within its limits";

equation
  w_limited = UrdfSync.Functions.limited(w_ref, parameters.minVelocity, parameters.maxVelocity);
  der(phi_ref) = if (phi_ref <= parameters.minPosition and w_limited < 0) or (phi_ref >= parameters.maxPosition and w_limited > 0) then 0 else w_limited;
  tau_asked = parameters.positionGain*(UrdfSync.Functions.limited(phi_ref, parameters.minPosition, parameters.maxPosition) - phi) - parameters.velocityGain*w;

  annotation (Documentation(info="<html>
<pre>
der(phi_ref) = w_ref
tau = positionGain*(phi_ref - phi) - velocityGain*w
</pre>
<p>
The command is kept between <code>minVelocity</code> and <code>maxVelocity</code>. The reference stops at <code>minPosition</code> and <code>maxPosition</code>, until the command
leads it back. It begins where the joint begins.
</p>
</html>"));
end RotationalIntegralServo;
