within UrdfSync.Drives;

model RotationalSweep "Moves one axis smoothly to the roomier end of its range and back"
  extends UrdfSync.Icons.RotationalDrive;

  parameter Modelica.Units.SI.Angle phi_start = 0
    "Position at the beginning"
    annotation (Dialog(group="Range"));

  parameter Modelica.Units.SI.Angle phi_min = -Modelica.Constants.inf
    "Smallest position"
    annotation (Dialog(group="Range"));

  parameter Modelica.Units.SI.Angle phi_max = Modelica.Constants.inf
    "Largest position"
    annotation (Dialog(group="Range"));

  parameter Modelica.Units.SI.AngularVelocity w_max = Modelica.Constants.inf
    "Largest speed"
    annotation (Dialog(group="Range"));

  parameter Modelica.Units.SI.Angle reach = 1
    "Longest way"
    annotation (Dialog(group="Motion"));

  parameter Modelica.Units.SI.Time period = 10
    "Time of the way there and back"
    annotation (Dialog(group="Motion"));

  final parameter Modelica.Units.SI.Angle phi_end = UrdfSync.Functions.sweepEnd(phi_start, phi_min, phi_max, w_max, period, reach)
    "Turning point";

  Modelica.Mechanics.Rotational.Interfaces.Flange_b flange
    "Axis that is moved"
    annotation (Placement(transformation(extent={{90, -10}, {110, 10}})));

  Modelica.Mechanics.Rotational.Interfaces.Support support
    "Housing of the drive"
    annotation (Placement(transformation(extent={{-10, -110}, {10, -90}})));

  Modelica.Units.SI.Angle phi(start = phi_start, stateSelect = StateSelect.prefer)
    "Position of the axis relative to the housing";

  Modelica.Units.SI.AngularVelocity w(start = 0, stateSelect = StateSelect.prefer)
    "Speed of the axis relative to the housing";

equation
  phi = flange.phi - support.phi;
  w = der(phi);
  der(w) = 2*(Modelica.Constants.pi/period)^2*(phi_end - phi_start)*cos(2*Modelica.Constants.pi*time/period);
  flange.tau + support.tau = 0;

  annotation (Documentation(info="<html>
<p>
The axis begins at rest and moves as <code>phi = phi_start + (phi_end - phi_start)*(1 - cos(2*pi*time/period))/2</code>. The range and the speed limit are
kept with a margin of 10 %. An axis without room stays where it is.
</p>
<p>
The joint that is moved has to begin there and at rest: its own start values are those that count. The acceleration is given and integrated, which is exact to the tolerance of the solver: a given position would have to be differentiated
twice through the equations of the robot, which takes compilers much longer where the base moves freely.
</p>
</html>"));
end RotationalSweep;
