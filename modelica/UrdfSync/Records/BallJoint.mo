within UrdfSync.Records;

record BallJoint "Numbers of a ball joint"
  extends UrdfSync.Records.Joint;

  parameter Modelica.Units.SI.RotationalDampingConstant damping(min = 0) = 0
    "Viscous damping";

  annotation (Documentation(info="<html>
<p>
A ball joint turns in all directions about the origin of its frame. Its damping is a torque against the relative angular velocity.
</p>
</html>"));
end BallJoint;
