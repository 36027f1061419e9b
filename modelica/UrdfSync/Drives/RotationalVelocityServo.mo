within UrdfSync.Drives;

model RotationalVelocityServo "Pushes a turning joint towards a commanded speed"
  extends UrdfSync.Drives.PartialRotationalServo;

  Modelica.Blocks.Interfaces.RealInput w_ref(unit = "rad/s")
    "How fast the joint is to go"
    annotation (Placement(transformation(extent={{-140, -20}, {-100, 20}})));

equation
  tau_asked = parameters.velocityGain*(UrdfSync.Functions.limited(w_ref, parameters.minVelocity, parameters.maxVelocity) - w);

  annotation (Documentation(info="<html>
<pre>
tau = velocityGain*(w_ref - w)
</pre>
<p>
The command is kept between <code>minVelocity</code> and <code>maxVelocity</code>. A load moves the joint even if the command is zero.
</p>
</html>"));
end RotationalVelocityServo;
