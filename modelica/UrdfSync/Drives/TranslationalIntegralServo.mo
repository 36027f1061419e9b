within UrdfSync.Drives;

model TranslationalIntegralServo "Pushes a sliding joint towards the integral of a commanded speed"
  extends UrdfSync.Drives.PartialTranslationalServo;

  parameter Modelica.Units.SI.Position s_start = 0
    "Reference at the beginning";

  Modelica.Blocks.Interfaces.RealInput v_ref(unit = "m/s")
    "How fast the reference is to go"
    annotation (Placement(transformation(extent={{-140, -20}, {-100, 20}})));

  Modelica.Units.SI.Position s_ref(start = s_start, fixed = true)
    "Reference: where the joint is to go";

  Modelica.Units.SI.Velocity v_limited
    "Commanded speed within its limits";

equation
  v_limited = UrdfSync.Functions.limited(v_ref, parameters.minVelocity, parameters.maxVelocity);
  der(s_ref) = if (s_ref <= parameters.minPosition and v_limited < 0) or (s_ref >= parameters.maxPosition and v_limited > 0) then 0 else v_limited;
  f_asked = parameters.positionGain*(UrdfSync.Functions.limited(s_ref, parameters.minPosition, parameters.maxPosition) - s) - parameters.velocityGain*v;

  annotation (Documentation(info="<html>
<pre>
der(s_ref) = v_ref
f = positionGain*(s_ref - s) - velocityGain*v
</pre>
<p>
The command is kept between <code>minVelocity</code> and <code>maxVelocity</code>. The reference stops at <code>minPosition</code> and <code>maxPosition</code>, until the command
leads it back. It begins where the joint begins.
</p>
</html>"));
end TranslationalIntegralServo;
