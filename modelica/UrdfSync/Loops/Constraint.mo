within UrdfSync.Loops;

model Constraint "Holds two frames together along some directions and about some axes"
  extends UrdfSync.Icons.Loop;
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;

  parameter Real translations[:, 3](each unit = "1") = identity(3)
    "Unit vectors resolved in frame_a, one per row: along these the origins of both frames coincide"
    annotation (Evaluate=true);

  parameter Real rotations[:, 3](each unit = "1") = fill(0, 0, 3)
    "Unit vectors resolved in frame_a, one per row: each stays perpendicular to the same row of childRotations"
    annotation (Evaluate=true);

  parameter Real childRotations[size(rotations, 1), 3](each unit = "1") = fill(0, 0, 3)
    "Unit vectors resolved in frame_b, one per row"
    annotation (Evaluate=true);

  parameter Real decay(unit = "1/s") = 100
    "Rate at which errors of the integration decay"
    annotation (Dialog(tab="Advanced"));

  Modelica.Units.SI.Distance gap = Modelica.Math.Vectors.length(frame_b.r_0 - frame_a.r_0)
    "Distance of the origins";

  Modelica.Units.SI.Force f[3] = {sum(f_c[i]*translations[i, k] for i in 1:size(translations, 1)) for k in 1:3}
    "Force on frame_b, resolved in frame_a";

  Modelica.Units.SI.Torque t[3] = {sum(t_c[i]*axes[i, k] for i in 1:size(rotations, 1)) for k in 1:3}
    "Torque on frame_b about its origin, resolved in frame_a";

protected
  Modelica.Mechanics.MultiBody.Frames.Orientation R_rel
    "From frame_a to frame_b";

  Modelica.Units.SI.Position r_rel[3]
    "From the origin of frame_a to that of frame_b, resolved in frame_a";

  Real rotated[size(rotations, 1), 3](each unit = "1")
    "childRotations resolved in frame_a";

  Real axes[size(rotations, 1), 3](each unit = "1")
    "Directions of the torques, resolved in frame_a";

  Modelica.Units.SI.Position r_c[size(translations, 1)](each stateSelect = StateSelect.never)
    "Distances along the translations";

  Modelica.Units.SI.Velocity v_c[size(translations, 1)](each stateSelect = StateSelect.never)
    "Their derivatives";

  Real c_c[size(rotations, 1)](each unit = "1", each stateSelect = StateSelect.never)
    "Cosines of the angles that are to be right ones";

  Real w_c[size(rotations, 1)](each unit = "1/s", each stateSelect = StateSelect.never)
    "Their derivatives";

  Modelica.Units.SI.Force f_c[size(translations, 1)]
    "Forces along the translations";

  Modelica.Units.SI.Torque t_c[size(rotations, 1)]
    "Torques of the rotations";

initial equation
  r_c = zeros(size(translations, 1));
  v_c = zeros(size(translations, 1));
  c_c = zeros(size(rotations, 1));
  w_c = zeros(size(rotations, 1));

equation
  R_rel = Modelica.Mechanics.MultiBody.Frames.relativeRotation(frame_a.R, frame_b.R);
  r_rel = Modelica.Mechanics.MultiBody.Frames.resolve2(frame_a.R, frame_b.r_0 - frame_a.r_0);
  rotated = childRotations*R_rel.T;

  r_c = translations*r_rel;
  v_c = der(r_c);
  der(v_c) = -2*decay*v_c - decay^2*r_c;

  w_c = der(c_c);
  der(w_c) = -2*decay*w_c - decay^2*c_c;
  for i in 1:size(rotations, 1) loop
    c_c[i] = rotations[i, :]*rotated[i, :];
    axes[i, :] = cross(rotations[i, :], rotated[i, :]);
  end for;

  frame_a.f = f;
  frame_a.t = t + cross(r_rel, f);
  frame_b.f = -Modelica.Mechanics.MultiBody.Frames.resolve2(R_rel, f);
  frame_b.t = -Modelica.Mechanics.MultiBody.Frames.resolve2(R_rel, t);

  annotation (Documentation(info="<html>
<pre>
r_i = e_i * r_rel                 e_i: a row of translations
c_i = u_i * (v_i in frame_a)      u_i: a row of rotations, v_i: the same row of childRotations
r_i'' + 2*decay*r_i' + decay^2*r_i = 0
c_i'' + 2*decay*c_i' + decay^2*c_i = 0
f = sum(e_i*f_i)
t = sum((u_i x v_i)*t_i)
</pre>
<p>
Each row removes one freedom, and brings one force <code>f_i</code> or torque <code>t_i</code>, which does no work along the motions that are left.
<code>frame_a.f</code> and <code>frame_a.t</code> are what the link at <code>frame_a</code> hands over to the link at <code>frame_b</code>.
</p>
<p>
A simulation begins with <code>r_i = r_i' = 0</code> and likewise for <code>c_i</code>: positions and speeds of joints that are not fixed at the start follow from that. From
then on the accelerations keep the loop closed, and all joints have states. What the integration leaves open decays (Baumgarte: Stabilization of constraints and integrals
of motion in dynamical systems, 1972), so that <code>gap</code> is of the size of the tolerance. With <code>r_i = 0</code> itself, positions would follow from
those of a few joints with states: where these stop and the others go on, simulations end, and compilers that solve for the positions anew at each time may find
another closed pose.
</p>
<table border=\"1\" cellspacing=\"0\" cellpadding=\"4\">
<tr><th align=\"left\">joint</th><th align=\"left\">translations</th><th align=\"left\">rotations, childRotations</th></tr>
<tr><td>ball</td><td>x, y, z</td><td></td></tr>
<tr><td>revolute about z</td><td>x, y, z</td><td>x, z; y, z</td></tr>
<tr><td>universal with axes z and x</td><td>x, y, z</td><td>z, x</td></tr>
<tr><td>fixed</td><td>x, y, z</td><td>x, y; y, z; z, x</td></tr>
<tr><td>planar loop with axes along z</td><td>x, y</td><td></td></tr>
</table>
</html>"));
end Constraint;
