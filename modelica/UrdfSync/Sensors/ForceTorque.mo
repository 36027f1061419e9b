within UrdfSync.Sensors;

model ForceTorque "Force and torque that a joint hands on"
  extends Modelica.Icons.RoundSensor;

  parameter UrdfSync.Records.Sensor parameters
    "Numbers of the sensor"
    annotation (Placement(transformation(extent={{-100, 80}, {-80, 100}})));

  input Modelica.Units.SI.Force f_joint[3]
    "Force at the joint, in the axes of the child link or of the parent link";

  input Modelica.Units.SI.Torque t_joint[3]
    "Torque about the origin of the joint, likewise";

  Modelica.Blocks.Interfaces.RealOutput f[3](each unit = "N")
    "Force, in the axes of the sensor"
    annotation (Placement(transformation(extent={{100, 30}, {120, 50}})));

  Modelica.Blocks.Interfaces.RealOutput t[3](each unit = "N.m")
    "Torque about the origin of the joint, in the axes of the sensor"
    annotation (Placement(transformation(extent={{100, -50}, {120, -30}})));

protected
  parameter Real R[3, 3](each unit = "1") = UrdfSync.Functions.rotation(parameters.origin.rpy)
    "Rotation of the sensor in the axes that it measures in";

equation
  f = f_joint*R;
  t = t_joint*R;

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-150, 80}, {150, 120}}, textColor={0, 0, 255}, textString="%name")}),
    Documentation(info="<html>
<p>
The fields <code>force</code> and <code>torque</code> of <code>geometry_msgs/Wrench</code>. A robot binds <code>f_joint</code> and <code>t_joint</code> to the cut-force and the
cut-torque at the joint's <code>frame_b</code>: what the child link does to the parent link, as Gazebo measures by default, about the origin of the joint.
</p>
</html>"));
end ForceTorque;
