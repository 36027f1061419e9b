within Post;

model PostGeneric "Robot Post from its record alone: every axis moves inside its limits"
  extends UrdfSync.Robots.PartialBench;
  extends Modelica.Icons.Example;

  UrdfSync.Robots.GenericRobot robot(
    redeclare parameter PostParameters data,
    fixedStart = false)
    "The robot"
    annotation (Placement(transformation(extent={{20, -60}, {60, -20}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {0, -50}, {0, -40}, {20, -40}}, color={95, 95, 95}, thickness=0.5));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Documentation(info="<html>
<p>
Robot Post as <code>UrdfSync.Robots.GenericRobot</code> reads it from its record. It simulates without inputs: every axis moves inside its limits and comes back. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end PostGeneric;
