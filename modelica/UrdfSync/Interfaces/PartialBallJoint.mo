within UrdfSync.Interfaces;

partial model PartialBallJoint "What ball joints have in common"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;

  replaceable parameter UrdfSync.Records.BallJoint parameters
    "Numbers of the joint"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-100, 80}, {-80, 100}})));

  parameter Boolean hasStates = true
    "= false, if a part beside the joint prescribes the orientation"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Advanced"));

  parameter Boolean fixedStart = true
    "= true, if the simulation begins at the start values"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Angle rpy_start[3] = {0, 0, 0}
    "Start values of roll, pitch and yaw of frame_b in the joint frame"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.AngularVelocity w_start[3] = {0, 0, 0}
    "Start value of the angular velocity of frame_b, resolved in the joint frame"
    annotation (Dialog(tab="Initialization"));

  annotation (Documentation(info="<html>
<p>
<code>frame_a</code> is connected to the parent link, <code>frame_b</code> to the child link. The joint turns in all directions, and has no flanges: its motion is free.
</p>
<p>
A robot that extends the generated one can drive it: a torque acts between its two frames, or a part that gives <code>frame_b.R</code> by <code>frame_a.R</code>, with
<code>hasStates = false</code>.
</p>
</html>"));
end PartialBallJoint;
