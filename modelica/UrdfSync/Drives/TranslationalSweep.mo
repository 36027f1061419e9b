within UrdfSync.Drives;

model TranslationalSweep "Moves one axis smoothly to the roomier end of its range and back"
  extends UrdfSync.Icons.TranslationalDrive;

  parameter Modelica.Units.SI.Position s_start = 0
    "Position at the beginning"
    annotation (Dialog(group="Range"));

  parameter Modelica.Units.SI.Position s_min = -Modelica.Constants.inf
    "Smallest position"
    annotation (Dialog(group="Range"));

  parameter Modelica.Units.SI.Position s_max = Modelica.Constants.inf
    "Largest position"
    annotation (Dialog(group="Range"));

  parameter Modelica.Units.SI.Velocity v_max = Modelica.Constants.inf
    "Largest speed"
    annotation (Dialog(group="Range"));

  parameter Modelica.Units.SI.Position reach = 0.1
    "Longest way"
    annotation (Dialog(group="Motion"));

  parameter Modelica.Units.SI.Time period = 10
    "Time of the way there and back"
    annotation (Dialog(group="Motion"));

  final parameter Modelica.Units.SI.Position s_end = UrdfSync.Functions.sweepEnd(s_start, s_min, s_max, v_max, period, reach)
    "Turning point";

  Modelica.Mechanics.Translational.Interfaces.Flange_b flange
    "Axis that is moved"
    annotation (Placement(transformation(extent={{90, -10}, {110, 10}})));

  Modelica.Mechanics.Translational.Interfaces.Support support
    "Housing of the drive"
    annotation (Placement(transformation(extent={{-10, -110}, {10, -90}})));

  Modelica.Units.SI.Position s(start = s_start, stateSelect = StateSelect.prefer)
    "Position of the axis relative to the housing";

  Modelica.Units.SI.Velocity v(start = 0, stateSelect = StateSelect.prefer)
    "Speed of the axis relative to the housing";

equation
  s = flange.s - support.s;
  v = der(s);
  der(v) = 2*(Modelica.Constants.pi/period)^2*(s_end - s_start)*cos(2*Modelica.Constants.pi*time/period);
  flange.f + support.f = 0;

  annotation (Documentation(info="<html>
<p>
The axis begins at rest and moves as <code>s = s_start + (s_end - s_start)*(1 - cos(2*pi*time/period))/2</code>. The range and the speed limit are
kept with a margin of 10 %. An axis without room stays where it is.
</p>
<p>
The joint that is moved has to begin there and at rest: its own start values are those that count. The acceleration is given and integrated, which is exact to the tolerance of the solver: a given position would have to be differentiated
twice through the equations of the robot, which takes compilers much longer where the base moves freely.
</p>
</html>"));
end TranslationalSweep;
