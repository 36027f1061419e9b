within UrdfSync.Records;

record PlanarJoint "Numbers of a planar joint"
  extends UrdfSync.Records.Joint;

  parameter Modelica.Mechanics.MultiBody.Types.Axis axis = {1, 0, 0}
    "Normal of the plane: a unit vector in the joint frame";

  JointDynamics.TranslationalDynamics translation
    "Losses of both sliding directions";

  JointDynamics.RotationalDynamics rotation
    "Losses of the turning direction";

  annotation (Documentation(info="<html>
<p>
A planar joint slides in a plane and turns about its normal. URDF has one pair of loss numbers for it: they count
once per direction of motion, in SI units.
</p>
</html>"));
end PlanarJoint;
