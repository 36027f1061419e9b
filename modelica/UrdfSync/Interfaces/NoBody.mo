within UrdfSync.Interfaces;

model NoBody "End of a link without mass"
  parameter Modelica.Units.SI.Mass m = 0
    "Mass in the record of the link, which has to be zero";

  Modelica.Mechanics.MultiBody.Interfaces.Frame_a frame_a
    "Link frame"
    annotation (Placement(transformation(extent={{-116, -16}, {-84, 16}})));

equation
  assert(m <= 0, getInstanceName() + ": the link has a mass, but no body. Set hasInertial = true in the record of the link");
  frame_a.f = {0, 0, 0};
  frame_a.t = {0, 0, 0};

  annotation (
    Icon(coordinateSystem(extent={{-100, -100}, {100, 100}}), graphics={
      Text(extent={{-150, 60}, {150, 100}}, textColor={0, 0, 255}, textString="%name"),
      Line(points={{-100, 0}, {0, 0}}, color={95, 95, 95}, thickness=0.5),
      Ellipse(extent={{0, -20}, {40, 20}}, lineColor={44, 82, 130}, lineThickness=0.5, fillColor={255, 255, 255}, fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
Takes the place of the body where the record of a link says <code>hasInertial = false</code>, as for the many links of a URDF that are frames and nothing else: no force and no torque acts on the
frame, and compilers have some sixty equations less than for a body whose mass is zero. A frame that ends nowhere would leave its force undetermined.
</p>
</html>"));
end NoBody;
