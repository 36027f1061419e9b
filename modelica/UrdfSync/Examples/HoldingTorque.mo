within UrdfSync.Examples;

model HoldingTorque "A bench by hand: a generated robot, driven by torque at one axis"
  extends Modelica.Icons.Example;

  inner Modelica.Mechanics.MultiBody.World world(n = {0, 0, -1})
    "Origin and gravity"
    annotation (Placement(transformation(extent={{-60, -50}, {-40, -30}})));

  UrdfSync.Examples.PlanarPlatform.PlanarPlatform robot
    "Platform with a boom on top"
    annotation (Placement(transformation(extent={{0, -60}, {40, -14}})));

  Modelica.Mechanics.Rotational.Components.SpringDamper holder(
    c = 200,
    d = 20)
    "Holds the boom where it is"
    annotation (Placement(transformation(extent={{-20, 10}, {0, 30}})));

equation
  connect(world.frame_b, robot.frame_a)
    annotation (Line(points={{-40, -40}, {0, -40}}, color={95, 95, 95}, thickness=0.5));
  connect(holder.flange_b, robot.boom_swingAxis)
    annotation (Line(points={{0, 20}, {0, -16}}, color={0, 0, 0}));
  connect(holder.flange_a, robot.boom_swingSupport)
    annotation (Line(points={{-20, 20}, {-26, 20}, {-26, -18}, {0, -18}}, color={0, 0, 0}));

  annotation (
    experiment(StopTime=2, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
Axis and housing of a drive are named after their joint, <code>robot.boom_swingAxis</code> and <code>robot.boom_swingSupport</code>. So a bench
stays right when the robot gets more joints.
</p>
</html>"));
end HoldingTorque;
