within UrdfSync.Examples.Utilities;

partial block PartialController "Controller of the six-axis arm that knows the numbers of the robot"
  extends Modelica.Blocks.Icons.DiscreteBlock;

  parameter Modelica.Units.SI.Time period = 0.002
    "Sampling period";

  parameter Modelica.Units.SI.Angle start[6]
    "Where the axes begin";

  parameter UrdfSync.Examples.SixAxisArm.SixAxisArmParameters data
    "Numbers of the robot, as the controller knows them"
    annotation (Placement(transformation(extent={{-100, 80}, {-80, 100}})));

  Modelica.Blocks.Interfaces.RealInput phi[6](each unit = "rad")
    "Positions of the axes"
    annotation (Placement(transformation(extent={{-140, 40}, {-100, 80}})));

  Modelica.Blocks.Interfaces.RealInput w[6](each unit = "rad/s")
    "Speeds of the axes"
    annotation (Placement(transformation(extent={{-140, -20}, {-100, 20}})));

  Modelica.Blocks.Interfaces.RealOutput tau[6](each unit = "N.m")
    "Torques of the motors"
    annotation (Placement(transformation(extent={{100, -10}, {120, 10}})));

protected
  UrdfSync.Types.JointPosition q[9]
    "Positions of the moving joints";

  UrdfSync.Types.JointVelocity v[9]
    "Velocities of the moving joints";

equation
  q = cat(1, phi, zeros(3));
  v = cat(1, w, zeros(3));

  annotation (Documentation(info="<html>
<p>
The functions of <a href=\"modelica://UrdfSync.Dynamics\">Dynamics</a> take <code>data.tree</code> from the record of the whole robot, which a package has if it is built with
<code>approach = [\"package\", \"record\"]</code>. Joints 7 to 9 are the fingers and the pinion of the gripper: they are taken as where they begin.
</p>
</html>"));
end PartialController;
