within UrdfSync.Interfaces;

partial model PartialPlanarJoint "What planar joints have in common"
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;

  replaceable parameter UrdfSync.Records.PlanarJoint parameters
    "Numbers of the joint"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-100, 80}, {-80, 100}})));

  parameter Boolean fixedStart = true
    "= true, if the simulation begins at the start values"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Position s_start[2] = {0, 0}
    "Start values of the sliding positions"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Velocity v_start[2] = {0, 0}
    "Start values of the sliding speeds"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Angle phi_start = 0
    "Start value of the angle"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.AngularVelocity w_start = 0
    "Start value of the turning speed"
    annotation (Dialog(tab="Initialization"));

  annotation (Documentation(info="<html>
<p>
<code>frame_a</code> is connected to the parent link, <code>frame_b</code> to the child link. It slides in a plane and turns about its normal, and has no flanges: its motion is
free.
</p>
</html>"));
end PartialPlanarJoint;
