within UrdfSync.Examples.CustomArm;

model CustomArm "Six-axis arm with an elastic elbow, a geared turret, a valve block and an inertial sensor"
  extends UrdfSync.Examples.SixAxisArm.SixAxisArm(
    redeclare ElasticElbow elbow,
    redeclare GearedTurret turret);

  Modelica.Mechanics.MultiBody.Parts.Body valveBlock(
    animation = animation,
    m = 1.5,
    r_CM = {0.08, 0, 0.07},
    I_11 = 0.002,
    I_22 = 0.003,
    I_33 = 0.003,
    sphereDiameter = 0.08,
    cylinderDiameter = 0.02)
    "Payload: pneumatic valves for the gripper"
    annotation (Placement(transformation(extent={{130, -90}, {150, -70}})));

  Imu imu(
    animation = animation,
    r = {0.01, 0.03, 0})
    "Inertial sensor"
    annotation (Placement(transformation(extent={{226, -90}, {246, -70}})));

equation
  connect(forearm.frame_a, valveBlock.frame_a)
    annotation (Line(points={{120, -26}, {116, -26}, {116, -80}, {130, -80}}, color={95, 95, 95}, thickness=0.5));
  connect(mounting_flange.frame_a, imu.frame_a)
    annotation (Line(points={{216, -26}, {212, -26}, {212, -80}, {226, -80}}, color={95, 95, 95}, thickness=0.5));

  annotation (
    Diagram(coordinateSystem(preserveAspectRatio=true, extent={{-116, -278}, {420, 62}})),
    Documentation(info="<html>
<p>
The generated robot with two joints exchanged and two parts attached. What was there keeps its name and its connectors, so this robot fits wherever the generated one
does: in its Run and Test models, in a bench of one's own.
</p>
<p>
The payload and the sensor hang on <code>forearm.frame_a</code> and <code>mounting_flange.frame_a</code>. Inside an extension every link can be connected to,
whether it has a frame outside or not. The sum <code>m</code> counts links only; give a link that is to count more its <code>m</code>, such as
<code>forearm(m = forearm.parameters.inertial.mass + valveBlock.m)</code>.
</p>
</html>"));
end CustomArm;
