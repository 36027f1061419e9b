within UrdfSync.Couplings;

model RotationalToRotational "A turning joint follows a turning joint"
  extends UrdfSync.Icons.Coupling;

  parameter UrdfSync.Records.RotationalMimic parameters
    "Multiplier and offset";

  Modelica.Mechanics.Rotational.Interfaces.Flange_a leader
    "Axis of the joint that is followed"
    annotation (Placement(transformation(extent={{-110, -10}, {-90, 10}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b follower
    "Axis of the joint that follows"
    annotation (Placement(transformation(extent={{90, -10}, {110, 10}})));

equation
  follower.phi = parameters.multiplier*leader.phi + parameters.offset;
  leader.tau + parameters.multiplier*follower.tau = 0;

  annotation (Documentation(info="<html>
<p>
The position relation of URDF's <code>&lt;mimic&gt;</code> element, and the balance of power without loss that follows from it
(principle of virtual work).
</p>
</html>"));
end RotationalToRotational;
