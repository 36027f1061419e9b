within UrdfSync.Icons;

partial model RevoluteJoint "Icon of revolute joints"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-130, -150}, {130, -110}}, textColor={0, 0, 255}, textString="%name"),
        Line(points={{0, 100}, {0, 36}}, color={110, 110, 110}, thickness=0.5),
        Line(points={{-60, 100}, {-60, 10}}, color={110, 110, 110}, thickness=0.5),
        Rectangle(extent={{-100, -12}, {0, 12}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{0, -12}, {100, 12}}, lineColor={186, 98, 20}, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-36, -36}, {36, 36}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-12, -12}, {12, 12}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={255, 255, 255},
            fillPattern=FillPattern.Solid),
        Polygon(points={{57, -39}, {63, -29}, {67, -18}, {69, -6}, {69, 6}, {67, 18}, {63, 29}, {57, 39}, {64, 43},
            {42, 51}, {45, 31}, {52, 36}, {57, 26}, {61, 16}, {63, 5}, {63, -5}, {61, -16}, {57, -26}, {52, -36},
            {45, -31}, {42, -51}, {64, -43}, {57, -39}}, pattern=LinePattern.None, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Line(points={{35, -41}, {50, -60}}, color={186, 98, 20}, thickness=1),
        Line(points={{35, 41}, {50, 60}}, color={186, 98, 20}, thickness=1)}),
    Documentation(info="<html>
<p>
A pivot with an arrow between two stops: it turns within limits. The axis is driven from the top, between the
fixed support (left) and the part that turns (right). The name stands below, where no connection runs; between
y = -100 and y = -60 there is room for a line of text.
</p>
</html>"));
end RevoluteJoint;
