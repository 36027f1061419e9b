within UrdfSync.Examples;

model ComputedTorque "An arm that follows a motion, by inverse dynamics and feedback: record approach"
  extends UrdfSync.Examples.Utilities.RecordMotorArm;

  UrdfSync.Examples.Utilities.ComputedTorqueController controller(start = start)
    "Gives the torques of the motors"
    annotation (Placement(transformation(extent={{-80, 10}, {-60, 30}})));

equation
  controller.phi = phi;
  controller.w = w;
  connect(controller.tau, motor.tau)
    annotation (Line(points={{-59, 20}, {-2, 20}}, color={0, 0, 127}));

  annotation (
    experiment(StopTime=0.8, Interval=0.01, Tolerance=1e-6),
    Documentation(info="<html>
<p>
The inverse dynamics of the robot's record and a feedback of the error give the torques: <a href=\"modelica://UrdfSync.Examples.Utilities.ComputedTorqueController\">ComputedTorqueController</a> has the equations.
The axes are elements of a vector, as the record approach has them.
<a href=\"modelica://UrdfSync.Examples.ComputedTorquePackage\">ComputedTorquePackage</a> is the same example with the robot of the package approach.
</p>
</html>"));
end ComputedTorque;
