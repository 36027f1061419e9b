within UrdfSync.Interfaces;

partial model PartialFixedJoint "What fixed joints have in common"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;

  replaceable parameter UrdfSync.Records.FixedJoint parameters
    "Numbers of the joint"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-100, 80}, {-80, 100}})));

  annotation (Documentation(info="<html>
<p>
<code>frame_a</code> is connected to the parent link, <code>frame_b</code> to the child link. There is nothing to drive.
</p>
</html>"));
end PartialFixedJoint;
