within UrdfSync.Examples.Utilities;

partial model PartialMotorArm "World, and what the sensors of an arm with motors measure"
  extends Modelica.Icons.Example;

  parameter Modelica.Units.SI.Angle start[6] = {0, 0.4, 0.6, 0, 0.5, 0}
    "Where the axes that turn begin";

  inner Modelica.Mechanics.MultiBody.World world(n = {0, 0, -1})
    "Origin and gravity"
    annotation (Placement(transformation(extent={{-20, -50}, {0, -30}})));

  Modelica.Units.SI.Angle phi[6]
    "Positions of the axes that turn: turret, shoulder, elbow, forearm_roll, wrist_pitch, flange_roll";

  Modelica.Units.SI.AngularVelocity w[6]
    "Their speeds";

  Modelica.Units.SI.Position r_tool[3]
    "Origin of link tool0, resolved in the world frame";

  Real R_tool[3, 3](each unit = "1")
    "Its rotation, v_world = R_tool*v_link";

  annotation (Documentation(info="<html>
<p>
<a href=\"modelica://UrdfSync.Examples.Utilities.NamedMotorArm\">NamedMotorArm</a> and
<a href=\"modelica://UrdfSync.Examples.Utilities.RecordMotorArm\">RecordMotorArm</a> have the robot, its motors and the equations of the sensors.
</p>
</html>"));
end PartialMotorArm;
