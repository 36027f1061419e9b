within UrdfSync.Interfaces;

partial model PartialLoop "What joints that close a loop have in common"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;

  replaceable parameter UrdfSync.Records.Loop parameters
    "Numbers of the joint"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-100, 80}, {-80, 100}})));

  Modelica.Units.SI.Distance gap
    "Distance of the origins of both frames of the joint";

  Modelica.Units.SI.Force f[3]
    "Force of the parent link on the child link, resolved in the parent's frame of the joint";

  Modelica.Units.SI.Torque t[3]
    "Torque of the parent link on the child link about the child's frame of the joint, resolved in the parent's";

  annotation (Documentation(info="<html>
<p>
<code>frame_a</code> is connected to the parent link, <code>frame_b</code> to the child link. Each of the two has a frame of the joint, at
<code>parameters.origin</code> and <code>parameters.childOrigin</code>.
</p>
<p>
In a model that extends the robot, a loop can be redeclared, for example by a bushing, that is a spring and a damper. Then the joints whose start is a guess
need one that is fixed (<code>fixedStart = true</code>), since no constraint closes the loop.
</p>
</html>"));
end PartialLoop;
