within UrdfSync.Examples;

model ToolPath "A tool that goes round in a circle, pulled by forces that the Jacobian turns into torques: record approach"
  extends UrdfSync.Examples.Utilities.RecordMotorArm;

  UrdfSync.Examples.Utilities.ToolController controller(start = start)
    "Gives the torques of the motors"
    annotation (Placement(transformation(extent={{-80, 10}, {-60, 30}})));

equation
  controller.phi = phi;
  controller.w = w;
  controller.r = r_tool;
  controller.R = R_tool;
  connect(controller.tau, motor.tau)
    annotation (Line(points={{-59, 20}, {-2, 20}}, color={0, 0, 127}));

  annotation (
    experiment(StopTime=2.2, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
A spring and a damper pull the tool round, and the transposed Jacobian of the robot's record turns their force into torques: <a href=\"modelica://UrdfSync.Examples.Utilities.ToolController\">ToolController</a> has the equations.
The axes are elements of a vector, as the record approach has them.
<a href=\"modelica://UrdfSync.Examples.ToolPathPackage\">ToolPathPackage</a> is the same example with the robot of the package approach.
</p>
</html>"));
end ToolPath;
