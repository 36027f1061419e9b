within UrdfSync.Couplings;

model HeldTranslational "A sliding joint follows a joint that never moves"
  extends UrdfSync.Icons.Coupling;

  parameter UrdfSync.Records.TranslationalMimic parameters
    "The offset is where the joint is held";

  Modelica.Mechanics.Translational.Interfaces.Flange_b follower
    "Axis of the joint that is held"
    annotation (Placement(transformation(extent={{90, -10}, {110, 10}})));

equation
  follower.s = parameters.offset;

  annotation (Documentation(info="<html>
<pre>
s_follower = c
</pre>
<p>
The offset <code>c</code> is in m. A fixed joint is at position zero all the time; so what follows it is held at the offset, and the multiplier has no effect. The coupling takes whatever
force that needs, in N.
</p>
</html>"));
end HeldTranslational;
