within UrdfSync.Records;

record FixedJoint "Numbers of a fixed joint"
  extends UrdfSync.Records.Joint;

  annotation (Documentation(info="<html>
<p>
A fixed joint has an origin only.
</p>
</html>"));
end FixedJoint;
