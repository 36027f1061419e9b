within UrdfSync.Robots;

partial model PartialRobot "What all robots have in common"

  parameter Boolean animation = true
    "= true, if visuals are drawn"
    annotation (Dialog(tab="Animation"));

  parameter Boolean showCollisions = false
    "= true, if collision shapes are drawn, in pink"
    annotation (Dialog(tab="Animation"));

  parameter Boolean checkLimits = true
    "= true, if a joint that passes one of its limits is reported by a warning"
    annotation (Dialog(group="Limits"));

  parameter Boolean fixedStart = true
    "= true, if the simulation begins at the start values of the joints; = false, if they are guesses, for axes that are driven by position"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Initialization"));

  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a
    "Frame of the root link"
    annotation (Placement(transformation(extent={{-116, -16}, {-84, 16}})));

  annotation (Documentation(info="<html>
<p>
The frame of the root link, and the switches that a robot hands down to its links and joints.
</p>
</html>"));
end PartialRobot;
