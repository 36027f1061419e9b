within UrdfSync.Couplings;

model HeldRotational "A turning joint follows a joint that never moves"
  extends UrdfSync.Icons.Coupling;

  parameter UrdfSync.Records.RotationalMimic parameters
    "The offset is where the joint is held";

  Modelica.Mechanics.Rotational.Interfaces.Flange_b follower
    "Axis of the joint that is held"
    annotation (Placement(transformation(extent={{90, -10}, {110, 10}})));

equation
  follower.phi = parameters.offset;

  annotation (Documentation(info="<html>
<pre>
phi_follower = c
</pre>
<p>
The offset <code>c</code> is in rad. A fixed joint is at position zero all the time; so what follows it is held at the offset, and the multiplier has no effect. The coupling takes whatever
torque that needs, in N.m.
</p>
</html>"));
end HeldRotational;
