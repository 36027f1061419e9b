within UrdfSync.Contacts.Functions;

partial function PartialForce "What the ground does to a shape: inputs and outputs that all shapes have"
  extends Modelica.Icons.Function;

  input Modelica.Units.SI.Position height
    "Height of the link frame above the ground";

  input Real n[3](each unit = "1")
    "Upward normal of the ground";

  input Modelica.Units.SI.Velocity v[3]
    "Velocity of the origin of the link frame";

  input Modelica.Units.SI.AngularVelocity w[3]
    "Angular velocity of the link";

  input Modelica.Units.SI.TranslationalSpringConstant stiffness
    "Stiffness of a point";

  input Real damping(unit = "s/m")
    "Damping of a point, as part of its spring force";

  input Real viscosity(unit = "N.s/m")
    "Damping of a point beside that, in parallel to its spring";

  input Real friction(unit = "1")
    "Coefficient of friction";

  input Modelica.Units.SI.Velocity slipSpeed
    "Speed at which sliding begins";

  input Modelica.Units.SI.Position xyz[3]
    "Origin of the shape frame";

  input Real R[3, 3](each unit = "1")
    "Axes of the shape frame, as columns";

  output Modelica.Units.SI.Force f[3]
    "Force on the link";

  output Modelica.Units.SI.Torque t[3]
    "Torque on the link about the origin of its frame";

  annotation (Documentation(info="<html>
<p>
All vectors are resolved in the frame of the link.
</p>
</html>"));
end PartialForce;
