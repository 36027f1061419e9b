within UrdfSync.Links;

record MeshLinkParameters "Numbers of mesh link"
  extends UrdfSync.Records.Link;

  UrdfSync.Records.Mesh visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync/Resources/robots/six_axis_arm/meshes/base_casting.stl",
    lower = {0, 0, 0},
    upper = {0, 0, 0},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 1";

  UrdfSync.Records.Mesh collision1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    uri = "modelica://UrdfSync/Resources/robots/six_axis_arm/meshes/base_casting.stl",
    lower = {0, 0, 0},
    upper = {0, 0, 0},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1";

  annotation (Documentation(info="<html>
<p>
Numbers of mesh link. To change them, extend the record, or modify them where it is used.
</p>
</html>"));
end MeshLinkParameters;
