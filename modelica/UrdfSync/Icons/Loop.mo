within UrdfSync.Icons;

partial model Loop "Icon of joints that close a loop"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-130, -110}, {130, -70}}, textColor={0, 0, 255}, textString="%name"),
        Rectangle(extent={{-100, -12}, {-20, 12}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{20, -12}, {100, 12}}, lineColor={24, 116, 128}, fillColor={205, 233, 236},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-54, -54}, {54, 54}}, lineColor={24, 116, 128}, lineThickness=1, startAngle=20, endAngle=340,
            closure=EllipseClosure.None),
        Ellipse(extent={{-28, -28}, {28, 28}}, lineColor={24, 116, 128}, lineThickness=0.5, fillColor={205, 233, 236},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-10, -10}, {10, 10}}, lineColor={24, 116, 128}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid),
        Polygon(points={{50, -8}, {62, -28}, {40, -26}, {50, -8}}, lineColor={24, 116, 128}, fillColor={24, 116, 128},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A pin between two links, and the way around that comes back to it.
</p>
</html>"));
end Loop;
