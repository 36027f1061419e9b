within UrdfSync.Examples.CustomArm;

model CustomArmTest "Quick check of the arm made by hand: every axis moves inside its limits"
  extends UrdfSync.Examples.SixAxisArm.SixAxisArmTest(redeclare CustomArm robot);

  annotation (
    experiment(StopTime=10, Interval=0.02, Tolerance=1e-6),
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-120, -220}, {340, 345}})),
    Documentation(info="<html>
<p>
The generated test model with another robot in it. Look at <code>robot.elbow.phi_elastic</code>, by how much the arm sags and swings behind its motor, at
<code>robot.turret.tau_motor</code>, and at <code>robot.imu.f</code> and <code>robot.imu.w</code>.
</p>
</html>"));
end CustomArmTest;
