within UrdfSync.Drives;

model TranslationalVelocityServo "Pushes a sliding joint towards a commanded speed"
  extends UrdfSync.Drives.PartialTranslationalServo;

  Modelica.Blocks.Interfaces.RealInput v_ref(unit = "m/s")
    "How fast the joint is to go"
    annotation (Placement(transformation(extent={{-140, -20}, {-100, 20}})));

equation
  f_asked = parameters.velocityGain*(UrdfSync.Functions.limited(v_ref, parameters.minVelocity, parameters.maxVelocity) - v);

  annotation (Documentation(info="<html>
<pre>
f = velocityGain*(v_ref - v)
</pre>
<p>
The command is kept between <code>minVelocity</code> and <code>maxVelocity</code>. A load moves the joint even if the command is zero.
</p>
</html>"));
end TranslationalVelocityServo;
