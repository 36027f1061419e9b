within UrdfSync.Friction;

model TranslationalLuGre "Viscous damping and dry friction of bristles that bend before they slide: the LuGre law"
  extends UrdfSync.Friction.PartialTranslational;

  Modelica.Units.SI.Position z(start = 0, fixed = true, nominal = 1e-5, stateSelect = StateSelect.always)
    "Mean deflection of the bristles";

protected
  Modelica.Units.SI.Position z_max
    "Deflection at which they slide";

equation
  z_max = parameters.bristleDeflection*(1 + (parameters.breakaway/parameters.friction - 1)*exp(-(v/parameters.stribeckSpeed)^2));
  der(z) = v - abs(v)*z/z_max;
  f = parameters.damping*v + parameters.friction/parameters.bristleDeflection*(z + parameters.bristleTime*der(z));

  annotation (Documentation(info="<html>
<p>
The law of <a href=\"modelica://UrdfSync.Friction.RotationalLuGre\">RotationalLuGre</a>, for a joint that slides.
</p>
</html>"));
end TranslationalLuGre;
