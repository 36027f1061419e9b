within UrdfSync.Friction;

model Ball "Viscous damping of a ball joint"
  extends UrdfSync.Icons.Friction;
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;

  parameter Modelica.Units.SI.RotationalDampingConstant damping
    "Viscous damping";

  Modelica.Units.SI.AngularVelocity w[3]
    "Angular velocity of frame_b relative to frame_a, resolved in frame_b";

  Modelica.Units.SI.Torque t[3] = damping*w
    "Loss torque, resolved in frame_b: it acts against the motion";

equation
  w = frame_b.R.w - Modelica.Mechanics.MultiBody.Frames.resolveRelative(frame_a.R.w, frame_a.R, frame_b.R);
  frame_a.f = zeros(3);
  frame_b.f = zeros(3);
  frame_a.t = -Modelica.Mechanics.MultiBody.Frames.resolveRelative(t, frame_b.R, frame_a.R);
  frame_b.t = t;

  annotation (Documentation(info="<html>
<p>
<code>t = damping*w</code>: the same damping about all axes.
</p>
</html>"));
end Ball;
