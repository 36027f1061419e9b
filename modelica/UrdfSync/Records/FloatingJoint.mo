within UrdfSync.Records;

record FloatingJoint "Numbers of a floating joint"
  extends UrdfSync.Records.Joint;

  annotation (Documentation(info="<html>
<p>
A floating joint has six degrees of freedom and an origin only.
</p>
</html>"));
end FloatingJoint;
