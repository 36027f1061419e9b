within UrdfSync.Icons;

partial model BallJoint "Icon of ball joints"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-130, -110}, {130, -70}}, textColor={0, 0, 255}, textString="%name"),
        Rectangle(extent={{-100, -12}, {-46, 12}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-56, -56}, {56, 56}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid, startAngle=50, endAngle=310),
        Rectangle(extent={{20, -12}, {100, 12}}, lineColor={190, 85, 20}, fillColor={250, 220, 195},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-40, -40}, {40, 40}}, lineColor={190, 85, 20}, lineThickness=0.5, fillColor={250, 220, 195},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A ball in its socket: it turns in all directions.
</p>
</html>"));
end BallJoint;
