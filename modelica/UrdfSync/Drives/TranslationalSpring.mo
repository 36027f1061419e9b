within UrdfSync.Drives;

model TranslationalSpring "Elastic drive that keeps the limits of a joint"
  extends Modelica.Mechanics.Translational.Interfaces.PartialCompliantWithRelativeStates;

  parameter UrdfSync.Records.TranslationalTransmission parameters
    "Stiffness and damping";

  parameter UrdfSync.Records.TranslationalLimits limits
    "Limits of effort and velocity";

equation
  f = -UrdfSync.Functions.limitedEffort(-parameters.stiffness*s_rel - parameters.damping*v_rel, der(flange_b.s), limits.effort, limits.velocity);

  annotation (Documentation(info="<html>
<p>
Spring and damper between a drive, at <code>flange_a</code>, and the joint, at <code>flange_b</code>, whose effort saturates as
<a href=\"modelica://UrdfSync.Functions.limitedEffort\">limitedEffort</a> says: where the drive prescribes a motion, it acts as a controller that asks for what the spring gives.
</p>
</html>"));
end TranslationalSpring;
