within UrdfSync.Icons;

partial model FixedJoint "Icon of fixed joints"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-130, -110}, {130, -70}}, textColor={0, 0, 255}, textString="%name"),
        Rectangle(extent={{-100, -12}, {-26, 12}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{26, -12}, {100, 12}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{-40, 25}, {40, 43}}, lineColor={90, 90, 90}, fillColor={110, 110, 110},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{-40, -43}, {40, -25}}, lineColor={90, 90, 90}, fillColor={110, 110, 110},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{-26, -54}, {0, 54}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{0, -54}, {26, 54}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
Two flanges, bolted together.
</p>
</html>"));
end FixedJoint;
