within UrdfSync.Dynamics;

function nonlinearEffects "Efforts of Coriolis, centrifugal and gravity forces"
  extends Modelica.Icons.Function;

  input UrdfSync.Records.RigidBodyTree tree
    "Bodies and joints: the component tree of the robot's record";

  input UrdfSync.Types.JointPosition q[:]
    "Positions of the moving joints";

  input UrdfSync.Types.JointVelocity v[:]
    "Velocities of the moving joints";

  input Modelica.Units.SI.Acceleration g_a[3] = {0, 0, -Modelica.Constants.g_n}
    "Gravity, resolved in the base frame";

  output UrdfSync.Types.JointEffort h[size(q, 1)]
    "Efforts of the moving joints at acceleration zero";

algorithm
  h := UrdfSync.Dynamics.inverseDynamics(tree, q, v, zeros(size(q, 1)), zeros(3), zeros(3), -g_a);

  annotation (Documentation(info="<html>
<p>
The vector <code>h</code> of <code>M*a + h = tau</code>, for a base at rest, by
<a href=\"modelica://UrdfSync.Dynamics.inverseDynamics\">inverseDynamics</a>.
</p>
</html>"));
end nonlinearEffects;
