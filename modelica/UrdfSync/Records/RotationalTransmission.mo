within UrdfSync.Records;

record RotationalTransmission "Gear and rotor of the drive of a turning joint"
  extends UrdfSync.Icons.Parameters;

  Real reduction(unit = "1") = 1
    "rad of the motor per rad of the joint";

  Modelica.Units.SI.Angle offset = 0
    "Position of the joint where the motor is at zero";

  Modelica.Units.SI.Inertia rotorInertia = 0
    "Inertia of the rotor, on the motor's side of the gear";

  Real otherReduction(unit = "1") = 0
    "rad of the motor per rad of another joint that it moves, as in a differential";

  Modelica.Units.SI.RotationalSpringConstant stiffness = 1e4
    "Stiffness between drive and joint, if the drive is elastic";

  Modelica.Units.SI.RotationalDampingConstant damping(min = 0) = 100
    "Damping in parallel to the stiffness";

  annotation (Documentation(info="<html>
<p>
The numbers of the <code>&lt;transmission&gt;</code> of a joint: position of the motor = reduction * (position of the joint - offset). A motor that
moves another joint, too, turns by <code>otherReduction</code> times the position of that one beside: see <a href=\"modelica://UrdfSync.Drives.SharedGear\">SharedGear</a>. Stiffness and
damping are no numbers of URDF, and count for drives that the option <code>elastic</code> names.
</p>
</html>"));
end RotationalTransmission;
