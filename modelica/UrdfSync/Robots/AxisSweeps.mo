within UrdfSync.Robots;

block AxisSweeps "Smooth ways of all axes of one kind to the roomier ends of their ranges and back"
  extends Modelica.Blocks.Interfaces.MO(final nout = n);

  parameter Integer n(min = 1) = 1
    "Number of axes";

  parameter Real start[n] = zeros(n)
    "Positions at the beginning, all in rad or all in m";

  parameter Real lower[n] = fill(-1, n)
    "Smallest positions";

  parameter Real upper[n] = fill(1, n)
    "Largest positions";

  parameter Real velocity[n] = fill(1, n)
    "Largest velocities";

  parameter Real reach = 1
    "Longest way";

  parameter Modelica.Units.SI.Time period = 10
    "Time of the way there and back";

  final parameter Real turn[n] = UrdfSync.Dynamics.sweepTurns(start, lower, upper, velocity, period, reach)
    "Turning points";

equation
  y = start + 0.5*(1 - cos(2*Modelica.Constants.pi*time/period))*(turn - start);

  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Line(points={{-84, -60}, {74, -60}}, color={160, 160, 160}),
        Polygon(points={{84, -60}, {70, -54}, {70, -66}, {84, -60}}, pattern=LinePattern.None, fillColor={160, 160, 160},
            fillPattern=FillPattern.Solid),
        Line(points={{-70, -74}, {-70, 74}}, color={160, 160, 160}),
        Polygon(points={{-70, 84}, {-76, 70}, {-64, 70}, {-70, 84}}, pattern=LinePattern.None, fillColor={160, 160, 160},
            fillPattern=FillPattern.Solid),
        Line(points={{-70, -60}, {-63, -57}, {-56, -49}, {-49, -35}, {-42, -19}, {-35, 0}, {-28, 19}, {-21, 35},
            {-14, 49}, {-7, 57}, {0, 60}, {7, 57}, {14, 49}, {21, 35}, {28, 19}, {35, 0}, {42, -19}, {49, -35},
            {56, -49}, {63, -57}, {70, -60}},
            color={186, 98, 20}, thickness=0.75)}),
    Documentation(info="<html>
<p>
Each axis begins at rest, moves along a cosine to its turning point and comes back. Ranges and velocities are kept with a margin
of 10 %. An axis without room stays where it is. The benches of robots that are read from a record drive all their axes so.
</p>
</html>"));
end AxisSweeps;
