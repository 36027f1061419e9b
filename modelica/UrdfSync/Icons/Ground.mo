within UrdfSync.Icons;

partial model Ground "Icon of the ground"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-150, 70}, {150, 110}}, textColor={0, 0, 255}, textString="%name"),
        Polygon(points={{-96, -44}, {56, -44}, {96, 14}, {-56, 14}, {-96, -44}}, lineColor={90, 90, 90},
            lineThickness=0.5, fillColor={224, 224, 224}, fillPattern=FillPattern.Solid),
        Line(points={{-58, -44}, {-18, 14}}, color={190, 190, 190}),
        Line(points={{-20, -44}, {20, 14}}, color={190, 190, 190}),
        Line(points={{18, -44}, {58, 14}}, color={190, 190, 190}),
        Line(points={{-83, -25}, {69, -25}}, color={190, 190, 190}),
        Line(points={{-69, -5}, {83, -5}}, color={190, 190, 190}),
        Polygon(points={{0, 47}, {-11, 29}, {-3, 29}, {-3, -15}, {3, -15}, {3, 29}, {11, 29}, {0, 47}},
            pattern=LinePattern.None, fillColor={160, 60, 50}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-7, -19}, {7, -11}}, lineColor={160, 60, 50}, fillColor={160, 60, 50},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A plane with its normal.
</p>
</html>"));
end Ground;
