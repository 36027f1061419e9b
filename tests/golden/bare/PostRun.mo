within Post;

model PostRun "Run robot Post with positions from outside: the model to export as FMU"
  extends UrdfSync.Robots.PartialBench;

  replaceable Post robot(
    fixedStart = false)
    "The robot"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{20, -200}, {320, 145}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-80, -50}, {20, -50}}, color={95, 95, 95}, thickness=0.5));

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 165}})),
    Documentation(info="<html>
<p>
Robot Post in its world, with one input per axis for its position and one output for what its drive has to give. The inputs are filtered, so that they need no derivatives. This file may be edited: urdfsync then keeps it, and reports when the URDF asks for something else.
</p>
</html>"));
end PostRun;
