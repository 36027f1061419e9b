within UrdfSync.Records;

record TranslationalTransmission "Gear and rotor of the drive of a sliding joint"
  extends UrdfSync.Icons.Parameters;

  Real reduction(unit = "rad/m") = 1
    "rad of the motor per m of the joint";

  Modelica.Units.SI.Position offset = 0
    "Position of the joint where the motor is at zero";

  Modelica.Units.SI.Inertia rotorInertia = 0
    "Inertia of the rotor, on the motor's side of the gear";

  Modelica.Units.SI.TranslationalSpringConstant stiffness = 1e6
    "Stiffness between drive and joint, if the drive is elastic";

  Modelica.Units.SI.TranslationalDampingConstant damping(min = 0) = 1e4
    "Damping in parallel to the stiffness";

  annotation (Documentation(info="<html>
<p>
The numbers of the <code>&lt;transmission&gt;</code> of a joint: position of the motor = reduction * (position of the joint - offset). Stiffness and
damping are no numbers of URDF, and count for drives that the option <code>elastic</code> names.
</p>
</html>"));
end TranslationalTransmission;
