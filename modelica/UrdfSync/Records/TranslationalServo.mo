within UrdfSync.Records;

record TranslationalServo "Law of the drive of a sliding joint"
  extends UrdfSync.Icons.Parameters;

  Modelica.Units.SI.TranslationalSpringConstant positionGain(min = 0) = 0
    "Force per difference between reference and position";

  Modelica.Units.SI.TranslationalDampingConstant velocityGain(min = 0) = 0
    "Force against the speed, or per difference between commanded and actual speed";

  Modelica.Units.SI.Position minPosition = -Modelica.Constants.inf
    "Smallest reference";

  Modelica.Units.SI.Position maxPosition = Modelica.Constants.inf
    "Largest reference";

  Modelica.Units.SI.Velocity minVelocity = -Modelica.Constants.inf
    "Smallest commanded speed";

  Modelica.Units.SI.Velocity maxVelocity = Modelica.Constants.inf
    "Largest commanded speed";

  Modelica.Units.SI.Force minEffort = -Modelica.Constants.inf
    "Smallest force";

  Modelica.Units.SI.Force maxEffort = Modelica.Constants.inf
    "Largest force";

  annotation (Documentation(info="<html>
<p>
All numbers are at the joint's side of a gear. The models of <a href=\"modelica://UrdfSync.Drives\">Drives</a> whose names end in <code>Servo</code> have the laws;
Run uses them for joints whose source states a law.
</p>
</html>"));
end TranslationalServo;
