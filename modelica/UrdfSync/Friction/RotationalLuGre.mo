within UrdfSync.Friction;

model RotationalLuGre "Viscous damping and dry friction of bristles that bend before they slide: the LuGre law"
  extends UrdfSync.Friction.PartialRotational;

  Modelica.Units.SI.Angle z(start = 0, fixed = true, nominal = 1e-4, stateSelect = StateSelect.always)
    "Mean deflection of the bristles";

protected
  Modelica.Units.SI.Angle z_max
    "Deflection at which they slide";

equation
  z_max = parameters.bristleDeflection*(1 + (parameters.breakaway/parameters.friction - 1)*exp(-(w/parameters.stribeckSpeed)^2));
  der(z) = w - abs(w)*z/z_max;
  tau = parameters.damping*w + parameters.friction/parameters.bristleDeflection*(z + parameters.bristleTime*der(z));

  annotation (Documentation(info="<html>
<pre>
tau    = d*w + s_0*z + s_1*der(z)
der(z) = w - |w|*z/z_max(w)
s_0*z_max(w) = tau_d + (tau_s - tau_d)*exp(-(w/w_s)^2)
</pre>
<p>
with damping <code>d</code>, dry friction <code>tau_d</code>, breakaway torque <code>tau_s</code> and Stribeck speed <code>w_s</code> of the record; the stiffness of the bristles is
<code>s_0 = tau_d/bristleDeflection</code>, their damping <code>s_1 = bristleTime*s_0</code> (Canudas de Wit, Olsson, &Aring;str&ouml;m, Lischinsky: A new model for control of systems with
friction, IEEE Transactions on Automatic Control 40, 1995). At a constant speed it is the law of Coulomb with Stribeck's peak.
</p>
<p>
It has no events, one state, and takes every motion that a drive prescribes. Below the breakaway torque the bristles bend and hold. They begin straight: at the beginning of a
simulation a loaded joint moves by less than <code>bristleDeflection</code> until they carry it. Where the breakaway torque is above the dry friction, they
feed no energy in as long as <code>d &gt;= s_1*(tau_s - tau_d)/tau_d</code>.
</p>
</html>"));
end RotationalLuGre;
