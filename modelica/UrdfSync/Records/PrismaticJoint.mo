within UrdfSync.Records;

record PrismaticJoint "Numbers of a prismatic joint"
  extends UrdfSync.Records.Joint;

  parameter Modelica.Mechanics.MultiBody.Types.Axis axis = {1, 0, 0}
    "Axis of motion: a unit vector in the joint frame";

  TranslationalLimits limits
    "Limits";

  JointDynamics.TranslationalDynamics dynamics
    "Losses, mechanisms, and what the drive adds to the inertia";

  TranslationalTransmission transmission
    "Gear and rotor of the drive";

  TranslationalServo servo
    "Law of the drive, if the source states one";

  TranslationalMimic mimic
    "How the joint follows another one, if it does";

  TranslationalCalibration calibration
    "Reference positions";

  TranslationalSafetyController safetyController
    "Soft limits";

  annotation (Documentation(info="<html>
<p>
A prismatic joint slides within limits.
</p>
</html>"));
end PrismaticJoint;
