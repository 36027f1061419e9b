within UrdfSync.Drives;

model SharedGear "Ideal gear between a motor and two turning joints, as a differential has two"
  extends Modelica.Mechanics.Rotational.Icons.Gear;

  parameter UrdfSync.Records.RotationalTransmission parameters
    "Reductions, offset and rotor";

  Modelica.Mechanics.Rotational.Interfaces.Flange_a flange_a
    "Motor"
    annotation (Placement(transformation(extent={{-10, -110}, {10, -90}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b flange_b
    "Axis of the motor's own joint"
    annotation (Placement(transformation(extent={{90, -10}, {110, 10}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b flange_c
    "Axis of the other joint"
    annotation (Placement(transformation(extent={{-110, -10}, {-90, 10}})));

  Modelica.Units.SI.AngularVelocity w
    "Speed of the motor";

  Modelica.Units.SI.Torque tau
    "Torque of the motor on the gear, beside what its rotor takes";

equation
  flange_a.phi = parameters.reduction*(flange_b.phi - parameters.offset) + parameters.otherReduction*flange_c.phi;
  w = der(flange_a.phi);
  tau = flange_a.tau - parameters.rotorInertia*der(w);
  flange_b.tau = -parameters.reduction*tau;
  flange_c.tau = -parameters.otherReduction*tau;

  annotation (Documentation(info="<html>
<pre>
phi_motor = n*(phi_joint - c) + m*phi_other
tau_joint = -n*tau        tau_other = -m*tau        tau = tau_motor - J*der(w)
</pre>
<p>
with <code>n</code>, <code>m</code>, <code>c</code> and <code>J</code> the numbers <code>reduction</code>, <code>otherReduction</code>, <code>offset</code> and <code>rotorInertia</code>
of the record. The torques balance the power for every motion. A differential has such a gear for each of its two motors, the first one with the first joint as its own, the second
one with the second. All housings are those of the joints, whose supports do not turn.
</p>
</html>"));
end SharedGear;
