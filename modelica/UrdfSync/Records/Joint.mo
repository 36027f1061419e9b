within UrdfSync.Records;

record Joint "Numbers of a joint"
  extends UrdfSync.Icons.Parameters;

  String name = ""
    "Name of the joint in the URDF";

  Origin origin
    "Joint frame (where the child link is at position zero) in the frame of the parent link";

  annotation (Documentation(info="<html>
<p>
What every joint has.
</p>
</html>"));
end Joint;
