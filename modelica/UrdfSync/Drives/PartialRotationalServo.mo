within UrdfSync.Drives;

partial model PartialRotationalServo "Drive of a turning joint that pushes by a law"
  extends UrdfSync.Icons.RotationalDrive;

  parameter UrdfSync.Records.RotationalServo parameters
    "Gains and limits";

  parameter Modelica.Units.SI.Torque tau_max = Modelica.Constants.inf
    "Limit of the torque, if the drive saturates";

  parameter Modelica.Units.SI.AngularVelocity w_max = Modelica.Constants.inf
    "Limit of the speed, if the drive saturates";

  Modelica.Mechanics.Rotational.Interfaces.Flange_b flange
    "Axis that is pushed"
    annotation (Placement(transformation(extent={{90, -10}, {110, 10}})));

  Modelica.Mechanics.Rotational.Interfaces.Support support
    "Housing of the drive"
    annotation (Placement(transformation(extent={{-10, -110}, {10, -90}})));

  Modelica.Units.SI.Angle phi
    "Position of the joint";

  Modelica.Units.SI.AngularVelocity w
    "Speed of the joint";

  Modelica.Units.SI.Torque tau_asked
    "Torque that the law asks for";

  Modelica.Units.SI.Torque tau
    "Torque that the drive gives";

equation
  phi = flange.phi - support.phi;
  w = der(phi);
  tau = UrdfSync.Functions.limitedEffort(
    UrdfSync.Functions.limited(tau_asked, parameters.minEffort, parameters.maxEffort),
    w,
    tau_max,
    w_max);
  flange.tau = -tau;
  support.tau = tau;

  annotation (Documentation(info="<html>
<p>
A model that extends this one has the law: it computes <code>tau_asked</code> from a command, from <code>phi</code> and from <code>w</code>. The drive gives this torque
between <code>minEffort</code> and <code>maxEffort</code> of its record. The limits <code>tau_max</code> and <code>w_max</code> act as
<a href=\"modelica://UrdfSync.Functions.limitedEffort\">limitedEffort</a> says.
</p>
</html>"));
end PartialRotationalServo;
