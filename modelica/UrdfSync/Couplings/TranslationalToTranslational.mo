within UrdfSync.Couplings;

model TranslationalToTranslational "A sliding joint follows a sliding joint"
  extends UrdfSync.Icons.Coupling;

  parameter UrdfSync.Records.TranslationalMimic parameters
    "Multiplier and offset";

  Modelica.Mechanics.Translational.Interfaces.Flange_a leader
    "Axis of the joint that is followed"
    annotation (Placement(transformation(extent={{-110, -10}, {-90, 10}})));

  Modelica.Mechanics.Translational.Interfaces.Flange_b follower
    "Axis of the joint that follows"
    annotation (Placement(transformation(extent={{90, -10}, {110, 10}})));

equation
  follower.s = parameters.multiplier*leader.s + parameters.offset;
  leader.f + parameters.multiplier*follower.f = 0;

  annotation (Documentation(info="<html>
<p>
The position relation of URDF's <code>&lt;mimic&gt;</code> element, and the balance of power without loss that follows from it
(principle of virtual work).
</p>
</html>"));
end TranslationalToTranslational;
