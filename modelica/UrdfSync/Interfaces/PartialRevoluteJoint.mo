within UrdfSync.Interfaces;

partial model PartialRevoluteJoint "What joints that turn about one axis have in common: revolute and continuous ones"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;

  replaceable parameter UrdfSync.Records.RevoluteJoint parameters
    "Numbers of the joint"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-100, 80}, {-80, 100}})));

  parameter Boolean checkLimits = true
    "= true, if passing a limit is reported by a warning"
    annotation (Dialog(group="Limits"));

  parameter Boolean checkEffort = true
    "= true, if the effort at axis is checked, too; = false, if axis is not all that drives the joint"
    annotation (Dialog(group="Limits"));

  parameter StateSelect stateSelect = StateSelect.prefer
    "Whether position and speed are taken as states"
    annotation (Dialog(tab="Advanced"));

  parameter Modelica.Units.SI.Angle phi_min = parameters.limits.lower
    "Smallest position in use: the limit, or where a joint that follows this one has its own"
    annotation (Dialog(tab="Advanced", group="Range in use"));

  parameter Modelica.Units.SI.Angle phi_max = parameters.limits.upper
    "Largest position in use: the limit, or where a joint that follows this one has its own"
    annotation (Dialog(tab="Advanced", group="Range in use"));

  parameter Modelica.Units.SI.AngularVelocity w_max = parameters.limits.velocity
    "Largest speed in use: the limit, or where a joint that follows this one has its own"
    annotation (Dialog(tab="Advanced", group="Range in use"));

  parameter Boolean fixedStart = true
    "= true, if the simulation begins at the start values; = false, if they are guesses"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Angle phi_start = UrdfSync.Functions.closestToZero(phi_min, phi_max)
    "Start value of the position: zero, or what is closest to it in the range in use"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.AngularVelocity w_start = 0
    "Start value of the speed"
    annotation (Dialog(tab="Initialization"));

  Modelica.Mechanics.Rotational.Interfaces.Flange_a axis
    "Drive"
    annotation (Placement(transformation(extent={{-10, 90}, {10, 110}})));

  Modelica.Mechanics.Rotational.Interfaces.Flange_b support
    "Housing of the drive"
    annotation (Placement(transformation(extent={{-70, 90}, {-50, 110}})));

  annotation (Documentation(info="<html>
<p>
<code>frame_a</code> is connected to the parent link, <code>frame_b</code> to the child link. A drive acts between <code>support</code> and
<code>axis</code>; without one the joint moves freely.
</p>
<p>
The range in use, <code>phi_min</code> to <code>phi_max</code>, is where the joint begins and where the Test model of a robot moves it. A robot narrows it
for a joint that others follow.
</p>
</html>"));
end PartialRevoluteJoint;
