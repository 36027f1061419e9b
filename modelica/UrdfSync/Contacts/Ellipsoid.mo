within UrdfSync.Contacts;

model Ellipsoid "Ellipsoid that touches the ground"
  extends UrdfSync.Contacts.PartialContact;

  parameter UrdfSync.Records.Ellipsoid parameters
    "Numbers of the collision";

protected
  final parameter Real R[3, 3](each unit = "1") = UrdfSync.Functions.rotation(parameters.origin.rpy)
    "Axes of the shape frame in frame_a, as columns";

equation
  (f, t) = UrdfSync.Contacts.Functions.ellipsoid(
    frame_a.r_0[3] - ground.height + minDepth,
    Modelica.Mechanics.MultiBody.Frames.resolve2(frame_a.R, {0, 0, 1}),
    Modelica.Mechanics.MultiBody.Frames.resolve2(frame_a.R, v_0),
    Modelica.Mechanics.MultiBody.Frames.angularVelocity2(frame_a.R),
    stiffness,
    damping,
    viscosity,
    friction,
    slipSpeed,
    parameters.origin.xyz,
    R,
    parameters.radii);

  annotation (
    Icon(graphics={
      Text(extent={{-150, -110}, {150, -80}}, textString="ellipsoid")}),
    Documentation(info="<html>
<p>
One contact point, the lowest of the surface.
</p>
</html>"));
end Ellipsoid;
