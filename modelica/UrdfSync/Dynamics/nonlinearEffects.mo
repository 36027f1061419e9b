within UrdfSync.Dynamics;

function nonlinearEffects "Efforts of Coriolis, centrifugal and gravity forces"
  extends Modelica.Icons.Function;

  input Integer jointTree[:, 2]
    "One row per moving joint: {number of the body that carries it, 1 if it turns or 2 if it slides}";

  input Real frames[size(jointTree, 1), 15]
    "One row per moving joint, as jointFrames gives them";

  input Real bodies[size(jointTree, 1) + 1, 10]
    "One row per body, as bodyInertias gives them";

  input Real q[size(jointTree, 1)]
    "Positions of the moving joints, in rad or m";

  input Real v[size(jointTree, 1)]
    "Speeds of the moving joints";

  input Modelica.Units.SI.Acceleration g_a[3] = {0, 0, -9.81}
    "Gravity, resolved in the base frame";

  output Real h[size(jointTree, 1)]
    "Efforts of the moving joints at acceleration zero";

protected
  Real tau[size(jointTree, 1) + 6] = UrdfSync.Dynamics.inverseDynamics(jointTree, frames, bodies, {0, 0, 0}, {0, 0, 0}, -g_a, q, v, zeros(size(jointTree, 1)));
algorithm
  h := tau[1:size(jointTree, 1)];

  annotation (Documentation(info="<html>
<p>
The vector <code>h</code> of <code>M*a + h = tau</code>, for a base at rest.
</p>
</html>"));
end nonlinearEffects;
