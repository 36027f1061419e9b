within UrdfSync.Drives;

model RotationalSpring "Elastic drive that keeps the limits of a joint"
  extends Modelica.Mechanics.Rotational.Interfaces.PartialCompliantWithRelativeStates;

  parameter UrdfSync.Records.RotationalTransmission parameters
    "Stiffness and damping";

  parameter UrdfSync.Records.RotationalLimits limits
    "Limits of effort and velocity";

equation
  tau = -UrdfSync.Functions.limitedEffort(-parameters.stiffness*phi_rel - parameters.damping*w_rel, der(flange_b.phi), limits.effort, limits.velocity);

  annotation (Documentation(info="<html>
<p>
Spring and damper between a drive, at <code>flange_a</code>, and the joint, at <code>flange_b</code>, whose effort saturates as
<a href=\"modelica://UrdfSync.Functions.limitedEffort\">limitedEffort</a> says: where the drive prescribes a motion, it acts as a controller that asks for what the spring gives.
</p>
</html>"));
end RotationalSpring;
