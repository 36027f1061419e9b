within UrdfSync.Drives;

model TranslationalPositionServo "Pushes a sliding joint towards a commanded position"
  extends UrdfSync.Drives.PartialTranslationalServo;

  Modelica.Blocks.Interfaces.RealInput s_ref(unit = "m")
    "Where the joint is to go"
    annotation (Placement(transformation(extent={{-140, -20}, {-100, 20}})));

equation
  f_asked = parameters.positionGain*(UrdfSync.Functions.limited(s_ref, parameters.minPosition, parameters.maxPosition) - s) - parameters.velocityGain*v;

  annotation (Documentation(info="<html>
<pre>
f = positionGain*(s_ref - s) - velocityGain*v
</pre>
<p>
The command is kept between <code>minPosition</code> and <code>maxPosition</code>. Under a load, the joint stays beside the command.
</p>
</html>"));
end TranslationalPositionServo;
