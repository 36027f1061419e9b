within UrdfSync.Couplings;

model TranslationalToTranslational "A sliding joint follows a sliding joint"
  extends UrdfSync.Icons.Coupling;

  parameter UrdfSync.Records.TranslationalMimic parameters
    "Multiplier and offset";

  parameter Modelica.Units.SI.Position s_min = -Modelica.Constants.inf
    "Smallest position of the joint that follows";

  parameter Modelica.Units.SI.Position s_max = Modelica.Constants.inf
    "Largest position of the joint that follows";

  parameter Modelica.Units.SI.Velocity v_max = Modelica.Constants.inf
    "Largest speed of the joint that follows";

  final parameter Boolean narrows = abs(parameters.multiplier) > Modelica.Constants.eps
    "= true, if the joint that follows moves at all, and so narrows the range of its leader";

  final parameter Modelica.Units.SI.Position leader_min = if not narrows then -Modelica.Constants.inf else min(
    UrdfSync.Functions.leaderPosition(parameters.multiplier, parameters.offset, s_min),
    UrdfSync.Functions.leaderPosition(parameters.multiplier, parameters.offset, s_max))
    "Smallest position of the leader at which the joint that follows keeps its range";

  final parameter Modelica.Units.SI.Position leader_max = if not narrows then Modelica.Constants.inf else max(
    UrdfSync.Functions.leaderPosition(parameters.multiplier, parameters.offset, s_min),
    UrdfSync.Functions.leaderPosition(parameters.multiplier, parameters.offset, s_max))
    "Largest position of the leader at which the joint that follows keeps its range";

  final parameter Modelica.Units.SI.Velocity leaderSpeed_max = if not narrows then Modelica.Constants.inf else abs(
    UrdfSync.Functions.leaderPosition(parameters.multiplier, 0, v_max))
    "Largest speed of the leader at which the joint that follows keeps its own";

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
