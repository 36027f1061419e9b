within UrdfSync.Icons;

partial model PrismaticJoint "Icon of prismatic joints"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-130, -150}, {130, -110}}, textColor={0, 0, 255}, textString="%name"),
        Line(points={{0, 100}, {0, 72}, {50, 72}, {50, 12}}, color={110, 110, 110}, thickness=0.5),
        Line(points={{-60, 100}, {-60, 30}}, color={110, 110, 110}, thickness=0.5),
        Rectangle(extent={{-100, -12}, {-72, 12}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{20, -12}, {100, 12}}, lineColor={38, 115, 65}, fillColor={205, 235, 213},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{-72, -30}, {20, 30}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Line(points={{-58, 12}, {20, 12}}, color={38, 115, 65}, pattern=LinePattern.Dash),
        Line(points={{-58, -12}, {20, -12}}, color={38, 115, 65}, pattern=LinePattern.Dash),
        Line(points={{-58, 12}, {-58, -12}}, color={38, 115, 65}, pattern=LinePattern.Dash),
        Polygon(points={{84, -46}, {66, -36}, {66, -43}, {-22, -43}, {-22, -36}, {-40, -46}, {-22, -56}, {-22, -49},
            {66, -49}, {66, -56}, {84, -46}}, pattern=LinePattern.None, fillColor={38, 115, 65},
            fillPattern=FillPattern.Solid),
        Line(points={{-40, -34}, {-40, -58}}, color={38, 115, 65}, thickness=1),
        Line(points={{84, -34}, {84, -58}}, color={38, 115, 65}, thickness=1)}),
    Documentation(info="<html>
<p>
A rod in a sleeve with an arrow between two stops: it slides within limits. The axis is driven from the top,
between the fixed support (left) and the part that slides (right). The name stands below, where no connection
runs; between y = -100 and y = -60 there is room for a line of text.
</p>
</html>"));
end PrismaticJoint;
