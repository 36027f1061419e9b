within UrdfSync.Dynamics;

function gravityEfforts "Efforts that hold a robot against gravity"
  extends Modelica.Icons.Function;

  input UrdfSync.Records.RigidBodyTree tree
    "Bodies and joints: the component tree of the robot's record";

  input UrdfSync.Types.JointPosition q[:]
    "Positions of the moving joints";

  input Modelica.Units.SI.Acceleration g_a[3] = {0, 0, -Modelica.Constants.g_n}
    "Gravity, resolved in the base frame";

  output UrdfSync.Types.JointEffort tau_g[size(q, 1)]
    "Efforts of the moving joints at rest";

algorithm
  tau_g := UrdfSync.Dynamics.inverseDynamics(tree, q, zeros(size(q, 1)), zeros(size(q, 1)), zeros(3), zeros(3), -g_a);

  annotation (Documentation(info="<html>
<p>
The vector of nonlinear effects at speed zero, <code>h(q, 0)</code>; what is left of it at other speeds are the Coriolis and centrifugal forces.
</p>
</html>"));
end gravityEfforts;
