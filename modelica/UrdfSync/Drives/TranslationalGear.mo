within UrdfSync.Drives;

model TranslationalGear "Ideal gear between a motor and a sliding joint"
  extends Modelica.Mechanics.Rotational.Interfaces.PartialElementaryRotationalToTranslational(
    final useSupportR = false,
    final useSupportT = true);

  parameter UrdfSync.Records.TranslationalTransmission parameters
    "Reduction and offset";

equation
  flangeR.phi - internalSupportR.phi = parameters.reduction*(flangeT.s - internalSupportT.s - parameters.offset);
  0 = parameters.reduction*flangeR.tau + flangeT.f;

  annotation (
    Icon(coordinateSystem(preserveAspectRatio=true, extent={{-100, -100}, {100, 100}}), graphics={
      Ellipse(extent={{-60, 40}, {20, -40}}, lineColor={64, 64, 64}, fillColor={192, 192, 192}, fillPattern=FillPattern.Solid),
      Rectangle(extent={{-60, -40}, {90, -56}}, lineColor={64, 64, 64}, fillColor={131, 175, 131}, fillPattern=FillPattern.Solid),
      Line(points={{-100, 0}, {-60, 0}}),
      Line(points={{90, -48}, {100, -48}, {100, 0}}, color={0, 127, 0}),
      Text(extent={{-150, 85}, {150, 125}}, textColor={0, 0, 255}, textString="%name")}),
    Documentation(info="<html>
<p>
<code>flangeR</code> is the motor's side, <code>flangeT</code> that of the joint: the <code>IdealGearR2T</code> of the Modelica Standard Library, with
the offset that a transmission of ROS has.
</p>
</html>"));
end TranslationalGear;
