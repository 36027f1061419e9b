within UrdfSync.Records;

record ContinuousJoint "Numbers of a continuous joint"
  extends UrdfSync.Records.Joint;

  parameter Modelica.Mechanics.MultiBody.Types.Axis axis = {1, 0, 0}
    "Axis of motion: a unit vector in the joint frame";

  RotationalLimits limits
    "Limits";

  RotationalDynamics dynamics
    "Losses";

  RotationalMimic mimic
    "How the joint follows another one, if it does";

  RotationalCalibration calibration
    "Reference positions";

  RotationalSafetyController safetyController
    "Soft limits";

  annotation (Documentation(info="<html>
<p>
A continuous joint turns without end stops; the position limits in <code>limits</code> have no effect.
</p>
</html>"));
end ContinuousJoint;
