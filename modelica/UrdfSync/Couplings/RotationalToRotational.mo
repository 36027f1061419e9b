within UrdfSync.Couplings;

model RotationalToRotational "A turning joint follows a turning joint"
  extends UrdfSync.Icons.Coupling;

  parameter UrdfSync.Records.RotationalMimic parameters
    "Multiplier and offset";

  parameter Modelica.Units.SI.Angle phi_min = -Modelica.Constants.inf
    "Smallest position of the joint that follows";

  parameter Modelica.Units.SI.Angle phi_max = Modelica.Constants.inf
    "Largest position of the joint that follows";

  parameter Modelica.Units.SI.AngularVelocity w_max = Modelica.Constants.inf
    "Largest speed of the joint that follows";

  final parameter Boolean narrows = abs(parameters.multiplier) > Modelica.Constants.eps
    "= true, if the joint that follows moves at all, and so narrows the range of its leader";

  final parameter Modelica.Units.SI.Angle leader_min = if not narrows then -Modelica.Constants.inf else min(
    UrdfSync.Functions.leaderPosition(parameters.multiplier, parameters.offset, phi_min),
    UrdfSync.Functions.leaderPosition(parameters.multiplier, parameters.offset, phi_max))
    "Smallest position of the leader at which the joint that follows keeps its range";

  final parameter Modelica.Units.SI.Angle leader_max = if not narrows then Modelica.Constants.inf else max(
    UrdfSync.Functions.leaderPosition(parameters.multiplier, parameters.offset, phi_min),
    UrdfSync.Functions.leaderPosition(parameters.multiplier, parameters.offset, phi_max))
    "Largest position of the leader at which the joint that follows keeps its range";

  final parameter Modelica.Units.SI.AngularVelocity leaderSpeed_max = if not narrows then Modelica.Constants.inf else abs(
    UrdfSync.Functions.leaderPosition(parameters.multiplier, 0, w_max))
    "Largest speed of the leader at which the joint that follows keeps its own";

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
<pre>
phi_follower = k*phi_leader + c
tau_leader = -k*tau_follower
</pre>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">
<tr><th align=\"left\">symbol</th><th align=\"left\">parameter</th><th align=\"left\">unit</th><th align=\"left\">meaning</th></tr>
<tr><td><code>phi_leader</code></td><td></td><td>rad</td><td>position of the joint that is followed</td></tr>
<tr><td><code>phi_follower</code></td><td></td><td>rad</td><td>position of the joint that follows</td></tr>
<tr><td><code>k</code></td><td><code>multiplier</code></td><td>1</td><td>motion of the follower per motion of the leader</td></tr>
<tr><td><code>c</code></td><td><code>offset</code></td><td>rad</td><td>position of the follower where the leader is at zero</td></tr>
<tr><td><code>tau_leader</code></td><td></td><td>N.m</td><td>torque into the coupling at the leader's axis</td></tr>
<tr><td><code>tau_follower</code></td><td></td><td>N.m</td><td>torque into the coupling at the follower's axis</td></tr>
</table>
<p>
The first equation is the position relation of URDF's <code>&lt;mimic&gt;</code> element. The second one is the balance of power
<code>tau_leader*der(phi_leader) + tau_follower*der(phi_follower) = 0</code> of a coupling without loss, inertia and play, for every motion that the first one allows
(principle of virtual work; Featherstone: Rigid Body Dynamics Algorithms, 2008, section 3.2).
</p>
</html>"));
end RotationalToRotational;
