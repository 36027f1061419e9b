within UrdfSync.Interfaces;

partial model PartialLink "What all links have in common"

  replaceable parameter UrdfSync.Records.Link parameters
    "Numbers of the link"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-100, 80}, {-80, 100}})));

  parameter Modelica.Units.SI.Mass m = parameters.inertial.mass
    "Mass, which the robot adds up: a link that carries more than its body says so here";

  parameter Boolean animation = true
    "= true, if visuals are drawn"
    annotation (Dialog(tab="Animation"));

  parameter Boolean showCollisions = false
    "= true, if collision shapes are drawn, in pink"
    annotation (Dialog(tab="Animation"));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a
    "Link frame"
    annotation (Placement(transformation(extent={{-116, -16}, {-84, 16}})));

  annotation (Documentation(info="<html>
<p>
A link has one frame, its numbers, and a mass. All joints that start at the link are connected to <code>frame_a</code>.
</p>
</html>"));
end PartialLink;
