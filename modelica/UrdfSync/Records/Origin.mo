within UrdfSync.Records;

record Origin "Pose of a child frame in its parent frame"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.Position xyz[3] = {0, 0, 0}
    "Origin of the child frame, resolved in the parent frame";

  Modelica.Units.SI.Angle rpy[3] = {0, 0, 0}
    "Roll, pitch and yaw: turns about the fixed x, y and z axes of the parent frame, in this order";

  annotation (Documentation(info="<html>
<p>
The <code>&lt;origin&gt;</code> element of URDF. A vector <code>v</code> of the child frame reads
<code>Rz(yaw)*Ry(pitch)*Rx(roll)*v</code> in the parent frame.
</p>
</html>"));
end Origin;
