within UrdfSync.Drives;

model RotationalGear "Ideal gear between a motor and a turning joint"
  extends Modelica.Mechanics.Rotational.Icons.Gear;
  extends Modelica.Mechanics.Rotational.Interfaces.PartialElementaryTwoFlangesAndSupport2(final useSupport = true);

  parameter UrdfSync.Records.RotationalTransmission parameters
    "Reduction and offset";

equation
  flange_a.phi - phi_support = parameters.reduction*(flange_b.phi - phi_support - parameters.offset);
  0 = parameters.reduction*flange_a.tau + flange_b.tau;

  annotation (Documentation(info="<html>
<p>
<code>flange_a</code> is the motor's side, <code>flange_b</code> that of the joint: the <code>IdealGear</code> of the Modelica Standard Library, with
the offset that a transmission of ROS has.
</p>
</html>"));
end RotationalGear;
