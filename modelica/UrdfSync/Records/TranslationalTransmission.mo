within UrdfSync.Records;

record TranslationalTransmission "Gear and rotor of the drive of a sliding joint"
  extends UrdfSync.Icons.Parameters;

  Real reduction(unit = "rad/m") = 1
    "rad of the motor per m of the joint";

  Modelica.Units.SI.Position offset = 0
    "Position of the joint where the motor is at zero";

  Modelica.Units.SI.Inertia rotorInertia = 0
    "Inertia of the rotor, on the motor's side of the gear";

  annotation (Documentation(info="<html>
<p>
The numbers of the <code>&lt;transmission&gt;</code> of a joint: position of the motor = reduction * (position of the joint - offset).
</p>
</html>"));
end TranslationalTransmission;
