within UrdfSync.Examples;

model ToolPathPackage "A tool that goes round in a circle, pulled by forces that the Jacobian turns into torques: package approach"
  extends UrdfSync.Examples.Utilities.NamedMotorArm;

  UrdfSync.Examples.Utilities.ToolController controller(start = start)
    "Gives the torques of the motors"
    annotation (Placement(transformation(extent={{-120, 235}, {-100, 255}})));

equation
  controller.phi = phi;
  controller.w = w;
  controller.r = r_tool;
  controller.R = R_tool;
  connect(controller.tau[1], turretMotor.tau)
    annotation (Line(points={{-99, 245}, {-80, 245}, {-80, 320}, {-42, 320}}, color={0, 0, 127}));
  connect(controller.tau[2], shoulderMotor.tau)
    annotation (Line(points={{-99, 245}, {-80, 245}, {-80, 290}, {-42, 290}}, color={0, 0, 127}));
  connect(controller.tau[3], elbowMotor.tau)
    annotation (Line(points={{-99, 245}, {-80, 245}, {-80, 260}, {-42, 260}}, color={0, 0, 127}));
  connect(controller.tau[4], forearm_rollMotor.tau)
    annotation (Line(points={{-99, 245}, {-80, 245}, {-80, 230}, {-42, 230}}, color={0, 0, 127}));
  connect(controller.tau[5], wrist_pitchMotor.tau)
    annotation (Line(points={{-99, 245}, {-80, 245}, {-80, 200}, {-42, 200}}, color={0, 0, 127}));
  connect(controller.tau[6], flange_rollMotor.tau)
    annotation (Line(points={{-99, 245}, {-80, 245}, {-80, 170}, {-42, 170}}, color={0, 0, 127}));

  annotation (
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-140, -280}, {360, 345}})),
    experiment(StopTime=2.2, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
A spring and a damper pull the tool round, and the transposed Jacobian of the robot's record turns their force into torques: <a href=\"modelica://UrdfSync.Examples.Utilities.ToolController\">ToolController</a> has the equations.
The axes are those of the package approach, each with its name: <code>robot.turretAxis</code> and so on.
<a href=\"modelica://UrdfSync.Examples.ToolPath\">ToolPath</a> is the same example with the robot of the record approach.
</p>
</html>"));
end ToolPathPackage;
