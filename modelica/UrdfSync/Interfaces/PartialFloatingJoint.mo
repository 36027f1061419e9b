within UrdfSync.Interfaces;

partial model PartialFloatingJoint "What floating joints have in common"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;

  replaceable parameter UrdfSync.Records.FloatingJoint parameters
    "Numbers of the joint"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-100, 80}, {-80, 100}})));

  parameter Boolean fixedStart = true
    "= true, if the simulation begins at the start values"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Position r_start[3] = {0, 0, 0}
    "Start value of the position of frame_b, resolved in the joint frame"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Angle rpy_start[3] = {0, 0, 0}
    "Start values of roll, pitch and yaw of frame_b in the joint frame"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Velocity v_start[3] = {0, 0, 0}
    "Start value of the velocity of frame_b, resolved in the joint frame"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.AngularVelocity w_start[3] = {0, 0, 0}
    "Start value of the angular velocity of frame_b, resolved in the joint frame"
    annotation (Dialog(tab="Initialization"));

  annotation (Documentation(info="<html>
<p>
<code>frame_a</code> is connected to the parent link, <code>frame_b</code> to the child link. It has six degrees of freedom, and has no flanges: its motion is
free.
</p>
</html>"));
end PartialFloatingJoint;
