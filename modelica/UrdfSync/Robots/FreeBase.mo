within UrdfSync.Robots;

model FreeBase "Six degrees of freedom with start values as URDF writes poses"
  extends UrdfSync.Icons.FloatingJoint;
  extends Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames;

  parameter Boolean fixedStart = true
    "= true, if the simulation begins at the start values"
    annotation (Evaluate=true, choices(checkBox=true), Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Position r_start[3] = {0, 0, 0}
    "Start value of the position of frame_b, resolved in frame_a"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Angle rpy_start[3] = {0, 0, 0}
    "Start values of roll, pitch and yaw of frame_b in frame_a"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.Velocity v_start[3] = {0, 0, 0}
    "Start value of the velocity of frame_b, resolved in frame_a"
    annotation (Dialog(tab="Initialization"));

  parameter Modelica.Units.SI.AngularVelocity w_start[3] = {0, 0, 0}
    "Start value of the angular velocity of frame_b, resolved in frame_a"
    annotation (Dialog(tab="Initialization"));

  Modelica.Mechanics.MultiBody.Joints.FreeMotion freeMotion(
    animation = false,
    r_rel_a(start = r_start, each fixed = fixedStart),
    v_rel_a(start = v_start, each fixed = fixedStart),
    angles_fixed = fixedStart,
    sequence_start = {3, 2, 1},
    angles_start = {rpy_start[3], rpy_start[2], rpy_start[1]},
    w_rel_a_fixed = fixedStart,
    w_rel_a_start = w_start)
    "Motion without constraint"
    annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));

equation
  connect(frame_a, freeMotion.frame_a)
    annotation (Line(points={{-100, 0}, {-10, 0}}, color={95, 95, 95}, thickness=0.5));
  connect(freeMotion.frame_b, frame_b)
    annotation (Line(points={{10, 0}, {100, 0}}, color={95, 95, 95}, thickness=0.5));

  annotation (Documentation(info="<html>
<p>
Free motion between two frames, started from the fixed-axis roll, pitch and yaw angles of URDF.
</p>
</html>"));
end FreeBase;
