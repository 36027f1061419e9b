within UrdfSync.Functions;

function rotation "Rotation matrix of roll, pitch and yaw"
  extends Modelica.Icons.Function;

  input Modelica.Units.SI.Angle rpy[3]
    "Turns about the fixed x, y and z axes of the parent frame, in this order";

  output Real R[3, 3](each unit = "1")
    "v_parent = R*v_child";

protected
  Real c[3] = {cos(rpy[1]), cos(rpy[2]), cos(rpy[3])};
  Real s[3] = {sin(rpy[1]), sin(rpy[2]), sin(rpy[3])};
algorithm
  R := [c[3]*c[2], c[3]*s[2]*s[1] - s[3]*c[1], c[3]*s[2]*c[1] + s[3]*s[1];
        s[3]*c[2], s[3]*s[2]*s[1] + c[3]*c[1], s[3]*s[2]*c[1] - c[3]*s[1];
        -s[2], c[2]*s[1], c[2]*c[1]];

  annotation (Documentation(info="<html>
<p>
<code>R = Rz(yaw)*Ry(pitch)*Rx(roll)</code>, the fixed-axis angles of URDF's <code>rpy</code> attribute
(the XYZ fixed angles of Craig: Introduction to Robotics, chapter 2).
</p>
</html>"));
end rotation;
