within UrdfSync.Links;

record CylinderLinkParameters "Numbers of cylinder link"
  extends UrdfSync.Records.Link;

  UrdfSync.Records.Cylinder visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.05,
    length = 0.1,
    color = {180, 180, 180},
    opacity = 1)
    "Visual 1";

  UrdfSync.Records.Cylinder collision1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radius = 0.05,
    length = 0.1,
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1";

  annotation (Documentation(info="<html>
<p>
Numbers of cylinder link. To change them, extend the record, or modify them where it is used.
</p>
</html>"));
end CylinderLinkParameters;
