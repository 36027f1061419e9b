within UrdfSync.Contacts;

model Points "Convex hull of a mesh that touches the ground"
  extends UrdfSync.Contacts.PartialContact;

  parameter UrdfSync.Records.Mesh parameters
    "Numbers of the collision; only its origin is used here";

  parameter Modelica.Units.SI.Position corners[:, 3]
    "Corners of the convex hull of the mesh, one per row, resolved in the shape frame";

protected
  final parameter Real R[3, 3](each unit = "1") = UrdfSync.Functions.rotation(parameters.origin.rpy)
    "Axes of the shape frame in frame_a, as columns";

equation
  (f, t) = UrdfSync.Contacts.Functions.points(
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
    corners);

  annotation (
    Icon(graphics={
      Text(extent={{-150, -110}, {150, -80}}, textString="mesh")}),
    Documentation(info="<html>
<p>
Every point of <code>corners</code> is a contact point. A hollow of the mesh does not matter: the ground is flat, so only points
of the convex hull can touch it. A wheel made of a mesh runs on its corners, as a polygon does; a cylinder runs smoothly.
</p>
</html>"));
end Points;
