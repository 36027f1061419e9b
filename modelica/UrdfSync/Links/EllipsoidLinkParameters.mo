within UrdfSync.Links;

record EllipsoidLinkParameters "Numbers of ellipsoid link"
  extends UrdfSync.Records.Link;

  UrdfSync.Records.Ellipsoid visual1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radii = {0.05, 0.05, 0.1},
    color = {180, 180, 180},
    opacity = 1)
    "Visual 1";

  UrdfSync.Records.Ellipsoid collision1(
    origin(
      xyz = {0, 0, 0},
      rpy = {0, 0, 0}),
    radii = {0.05, 0.05, 0.1},
    color = {255, 105, 180},
    opacity = 0.5)
    "Collision 1";

  annotation (Documentation(info="<html>
<p>
Numbers of ellipsoid link. To change them, extend the record, or modify them where it is used.
</p>
</html>"));
end EllipsoidLinkParameters;
