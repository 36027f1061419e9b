within UrdfSync.Examples;

model ComputedTorquePackage "An arm that follows a motion, by inverse dynamics and feedback: package approach"
  extends UrdfSync.Examples.Utilities.NamedMotorArm;

  UrdfSync.Examples.Utilities.ComputedTorqueController controller(start = start)
    "Gives the torques of the motors"
    annotation (Placement(transformation(extent={{-120, 235}, {-100, 255}})));

equation
  controller.phi = phi;
  controller.w = w;
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
    experiment(StopTime=0.8, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
The inverse dynamics of the robot's record and a feedback of the error give the torques: <a href=\"modelica://UrdfSync.Examples.Utilities.ComputedTorqueController\">ComputedTorqueController</a> has the equations.
The axes are those of the package approach, each with its name: <code>robot.turretAxis</code> and so on.
<a href=\"modelica://UrdfSync.Examples.ComputedTorque\">ComputedTorque</a> is the same example with the robot of the record approach.
</p>
</html>"));
end ComputedTorquePackage;
