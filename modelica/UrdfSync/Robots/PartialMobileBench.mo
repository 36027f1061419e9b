within UrdfSync.Robots;

partial model PartialMobileBench "World, ground, and six degrees of freedom for a mobile robot"
  extends UrdfSync.Robots.PartialBench;

  replaceable parameter UrdfSync.Records.Stance stance
    "How the robot stands at the beginning"
    annotation (choicesAllMatching=true, Placement(transformation(extent={{-20, -100}, {0, -80}})));

  parameter Modelica.Units.SI.Position r_start[3] = {0, 0, stance.height}
    "Where the root frame begins, resolved in the world frame"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Angle rpy_start[3] = {0, 0, 0}
    "Roll, pitch and yaw of the root frame at the beginning"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Velocity v_start[3] = {0, 0, 0}
    "Velocity of the root frame at the beginning, resolved in the world frame"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.AngularVelocity w_start[3] = {0, 0, 0}
    "Angular velocity of the root frame at the beginning, resolved in the world frame"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Force load = 100
    "Weight of the robot: sets the stiffness of the ground"
    annotation (Dialog(group="Ground"));

  inner UrdfSync.Contacts.Ground ground(load = load)
    "Ground that the collision shapes touch"
    annotation (Placement(transformation(extent={{-60, -100}, {-40, -80}})));

  UrdfSync.Robots.FreeBase base(
    r_start = r_start,
    rpy_start = rpy_start,
    v_start = v_start,
    w_start = w_start)
    "The robot moves freely"
    annotation (Placement(transformation(extent={{-60, -60}, {-40, -40}})));

equation
  connect(world.frame_b, base.frame_a)
    annotation (Line(points={{-80, -50}, {-60, -50}}, color={95, 95, 95}, thickness=0.5));

  annotation (Documentation(info="<html>
<p>
The robot is connected to <code>base.frame_b</code>.
</p>
</html>"));
end PartialMobileBench;
