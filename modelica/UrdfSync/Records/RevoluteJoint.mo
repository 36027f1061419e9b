within UrdfSync.Records;

record RevoluteJoint "Numbers of a revolute joint"
  extends UrdfSync.Records.Joint;

  parameter Modelica.Mechanics.MultiBody.Types.Axis axis = {1, 0, 0}
    "Axis of motion: a unit vector in the joint frame";

  RotationalLimits limits
    "Limits";

  JointDynamics.RotationalDynamics dynamics
    "Losses, mechanisms, and what the drive adds to the inertia";

  RotationalTransmission transmission
    "Gear and rotor of the drive";

  RotationalServo servo
    "Law of the drive, if the source states one";

  RotationalMimic mimic
    "How the joint follows another one, if it does";

  RotationalCalibration calibration
    "Reference positions";

  RotationalSafetyController safetyController
    "Soft limits";

  annotation (Documentation(info="<html>
<p>
A revolute joint turns within limits.
</p>
</html>"));
end RevoluteJoint;
