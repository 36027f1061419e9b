within UrdfSync.Records;

record ContinuousJoint "Numbers of a continuous joint"
  extends UrdfSync.Records.RevoluteJoint;

  annotation (Documentation(info="<html>
<p>
A continuous joint turns without end stops: it has the numbers of a revolute one, and the position limits among them have no effect.
</p>
</html>"));
end ContinuousJoint;
