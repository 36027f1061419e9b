within UrdfSync.Records;

record Loop "Numbers of a joint that closes a loop"
  extends UrdfSync.Icons.Parameters;

  String name = ""
    "Name of the loop";

  Origin origin
    "Frame of the joint in the frame of the parent link";

  Origin childOrigin
    "Frame of the joint in the frame of the child link";

  Real translations[:, 3](each unit = "1") = identity(3)
    "Unit vectors in the parent's frame of the joint, one per row: along these the origins of both frames coincide";

  Real rotations[:, 3](each unit = "1") = fill(0, 0, 3)
    "Unit vectors in the parent's frame of the joint, one per row: each stays perpendicular to the same row of childRotations";

  Real childRotations[:, 3](each unit = "1") = fill(0, 0, 3)
    "Unit vectors in the child's frame of the joint, one per row";

  annotation (Documentation(info="<html>
<p>
The loop is closed where both frames of the joint are one, but for the motions that the joint leaves. The rows are the equations that hold it:
<a href=\"modelica://UrdfSync.Loops.Constraint\">Constraint</a> explains them.
</p>
</html>"));
end Loop;
