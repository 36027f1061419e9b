within UrdfSync.Visualizers;

partial model PartialShape "What all shapes have in common"
  extends UrdfSync.Icons.Visualizer;

  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a
    "Link frame, in which the record places the shape"
    annotation (Placement(transformation(extent={{-116, -16}, {-84, 16}})));

  parameter Boolean animation = true
    "= true, if the shape is drawn";

protected
  outer Modelica.Mechanics.MultiBody.World world
    "The world says whether there is an animation";

equation
  frame_a.f = zeros(3);
  frame_a.t = zeros(3);

  annotation (Documentation(info="<html>
<p>
A frame without force and torque, and the switch of the animation.
</p>
</html>"));
end PartialShape;
