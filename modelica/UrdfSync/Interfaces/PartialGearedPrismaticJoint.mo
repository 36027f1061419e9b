within UrdfSync.Interfaces;

partial model PartialGearedPrismaticJoint "What joints with the gear and the motor's side of a drive have in common"
  extends UrdfSync.Interfaces.PartialPrismaticJoint;

  Modelica.Mechanics.Rotational.Interfaces.Flange_a motor
    "Motor, at its own side of the gear"
    annotation (Placement(transformation(extent={{70, 90}, {90, 110}})));

  annotation (Documentation(info="<html>
<p>
A joint that slides along one axis, with the gear of its drive: a motor acts between <code>support</code> and <code>motor</code>, which is at
<code>reduction*(position of the joint - offset)</code>. <code>axis</code> is the joint's side of the gear. Rotor and gear are parts of one dimension: torques by which
the rotor resists a turn of its axis in space are left out.
</p>
</html>"));
end PartialGearedPrismaticJoint;
