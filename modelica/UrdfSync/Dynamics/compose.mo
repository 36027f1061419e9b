within UrdfSync.Dynamics;

function compose "Frame that is placed in another one as URDF does it"
  extends Modelica.Icons.Function;

  input Real frame[12]
    "The other one: {rotation matrix by rows, position}";

  input Modelica.Units.SI.Position xyz[3]
    "Position in the other frame";

  input Modelica.Units.SI.Angle rpy[3]
    "Roll, pitch and yaw in the other frame";

  output Real placed[12]
    "{rotation matrix by rows, position}";

protected
  Real R[3, 3] = [frame[1], frame[2], frame[3]; frame[4], frame[5], frame[6]; frame[7], frame[8], frame[9]];
  Real S[3, 3] = R*UrdfSync.Functions.rotation(rpy);
  Real r[3] = R*xyz;
algorithm
  placed := {S[1, 1], S[1, 2], S[1, 3], S[2, 1], S[2, 2], S[2, 3], S[3, 1], S[3, 2], S[3, 3],
    frame[10] + r[1], frame[11] + r[2], frame[12] + r[3]};

  annotation (Documentation(info="<html>
<p>
The product of two homogeneous transformations (Craig: Introduction to Robotics, section 2.3).
</p>
</html>"));
end compose;
