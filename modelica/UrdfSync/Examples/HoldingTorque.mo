within UrdfSync.Examples;

model HoldingTorque "A bench by hand: a generated robot, driven by torque at one axis"
  extends Modelica.Icons.Example;

  inner Modelica.Mechanics.MultiBody.World world(n = {0, 0, -1})
    "Origin and gravity"
    annotation (Placement(transformation(extent={{-60, -50}, {-40, -30}})));

  UrdfSync.Examples.PlanarPlatform.PlanarPlatform robot
    "Platform with a boom on top"
    annotation (Placement(transformation(extent={{0, -60}, {40, -20}})));

  Modelica.Mechanics.Rotational.Components.SpringDamper holder(
    c = 200,
    d = 20)
    "Holds the boom where it is"
    annotation (Placement(transformation(extent={{-20, 10}, {0, 30}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-40, -40}, {0, -40}}, color={95, 95, 95}, thickness=0.5));
  connect(holder.flange_b, robot.rotationalAxis[robot.boom_swingAxis])
    annotation (Line(points={{0, 20}, {8, 20}, {8, -20}}, color={0, 0, 0}));
  connect(holder.flange_a, robot.rotationalSupport[robot.boom_swingAxis])
    annotation (Line(points={{-20, 20}, {-26, 20}, {-26, 0}, {14, 0}, {14, -20}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=2, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
The axis is named by its constant, <code>robot.boom_swingAxis</code>. A bench that does so stays right when the robot gets
more joints and its axes get other numbers.
</p>
</html>"));
end HoldingTorque;
