within UrdfSync.Records;

record RotationalServo "Law of the drive of a turning joint"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.RotationalSpringConstant positionGain(min = 0) = 0
    "Torque per difference between reference and position";

  Modelica.Units.SI.RotationalDampingConstant velocityGain(min = 0) = 0
    "Torque against the speed, or per difference between commanded and actual speed";

  Modelica.Units.SI.Angle minPosition = -Modelica.Constants.inf
    "Smallest reference";

  Modelica.Units.SI.Angle maxPosition = Modelica.Constants.inf
    "Largest reference";

  Modelica.Units.SI.AngularVelocity minVelocity = -Modelica.Constants.inf
    "Smallest commanded speed";

  Modelica.Units.SI.AngularVelocity maxVelocity = Modelica.Constants.inf
    "Largest commanded speed";

  Modelica.Units.SI.Torque minEffort = -Modelica.Constants.inf
    "Smallest torque";

  Modelica.Units.SI.Torque maxEffort = Modelica.Constants.inf
    "Largest torque";

  annotation (Documentation(info="<html>
<p>
All numbers are at the joint's side of a gear. The models of <a href=\"modelica://UrdfSync.Drives\">Drives</a> whose names end in <code>Servo</code> have the laws;
Run uses them for joints whose source states a law.
</p>
</html>"));
end RotationalServo;
