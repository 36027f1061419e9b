within UrdfSync.Friction;

partial model PartialRotational "What laws of friction between two rotational flanges have in common"
  extends UrdfSync.Icons.Friction;
  extends Modelica.Mechanics.Rotational.Interfaces.PartialTwoFlanges;

  parameter UrdfSync.Records.JointDynamics.RotationalDynamics parameters
    "Numbers of the losses";

  Modelica.Units.SI.Angle phi_rel
    "Position of flange_b relative to flange_a";

  Modelica.Units.SI.AngularVelocity w
    "Speed of flange_b relative to flange_a";

  Modelica.Units.SI.Torque tau
    "Loss torque: it acts against the motion";

equation
  phi_rel = flange_b.phi - flange_a.phi;
  w = der(phi_rel);
  flange_b.tau = tau;
  flange_a.tau = -tau;

  annotation (Documentation(info="<html>
<p>
A law that extends this class gives <code>tau</code>.
</p>
</html>"));
end PartialRotational;
