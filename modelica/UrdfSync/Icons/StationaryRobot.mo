within UrdfSync.Icons;

partial model StationaryRobot "Icon of robots that are bolted to the ground"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-150, -150}, {150, -110}}, textColor={0, 0, 255}, textString="%name"),
        Rectangle(extent={{-100, -100}, {100, 100}}, lineColor={44, 82, 130}, lineThickness=0.5,
            fillColor={255, 255, 255}, fillPattern=FillPattern.Solid, radius=14),
        Line(points={{-80, -70}, {80, -70}}, color={90, 90, 90}, thickness=0.75),
        Line(points={{-64, -70}, {-76, -82}}, color={90, 90, 90}),
        Line(points={{-48, -70}, {-60, -82}}, color={90, 90, 90}),
        Line(points={{-32, -70}, {-44, -82}}, color={90, 90, 90}),
        Line(points={{-16, -70}, {-28, -82}}, color={90, 90, 90}),
        Line(points={{0, -70}, {-12, -82}}, color={90, 90, 90}),
        Line(points={{16, -70}, {4, -82}}, color={90, 90, 90}),
        Line(points={{32, -70}, {20, -82}}, color={90, 90, 90}),
        Line(points={{48, -70}, {36, -82}}, color={90, 90, 90}),
        Line(points={{64, -70}, {52, -82}}, color={90, 90, 90}),
        Line(points={{80, -70}, {68, -82}}, color={90, 90, 90}),
        Rectangle(extent={{-66, -70}, {8, -58}}, lineColor={90, 90, 90}, lineThickness=0.5, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{-60, -58}, {-52, -51}}, lineColor={90, 90, 90}, fillColor={110, 110, 110},
            fillPattern=FillPattern.Solid),
        Rectangle(extent={{-6, -58}, {2, -51}}, lineColor={90, 90, 90}, fillColor={110, 110, 110},
            fillPattern=FillPattern.Solid),
        Polygon(points={{-48, -58}, {-10, -58}, {-16, -28}, {-42, -28}, {-48, -58}}, lineColor={90, 90, 90},
            lineThickness=0.5, fillColor={224, 224, 224}, fillPattern=FillPattern.Solid),
        Polygon(points={{22, 22}, {27, 15}, {30, 17}, {42, -3}, {48, 1}, {35, 20}, {50, 29}, {62, 10}, {67, 13},
            {55, 33}, {59, 35}, {54, 42}, {22, 22}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Polygon(points={{32, 23}, {36, 20}, {41, 19}, {45, 20}, {49, 24}, {50, 29}, {48, 33}, {23, 73}, {19, 77},
            {15, 78}, {10, 76}, {7, 73}, {6, 68}, {7, 63}, {32, 23}}, lineColor={44, 82, 130}, lineThickness=0.5,
            fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Polygon(points={{18, 59}, {22, 62}, {24, 67}, {24, 72}, {21, 76}, {17, 78}, {12, 77}, {-55, 52}, {-59, 49},
            {-61, 45}, {-61, 40}, {-58, 36}, {-54, 34}, {-49, 34}, {18, 59}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Polygon(points={{-43, 46}, {-46, 50}, {-50, 52}, {-55, 52}, {-59, 49}, {-61, 45}, {-61, 40}, {-38, -25},
            {-35, -29}, {-31, -31}, {-26, -31}, {-22, -28}, {-20, -24}, {-20, -19}, {-43, 46}}, lineColor={44, 82, 130},
            lineThickness=0.5, fillColor={200, 217, 240}, fillPattern=FillPattern.Solid),
        Ellipse(extent={{-40, -34}, {-18, -10}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-64, 32}, {-41, 55}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{4, 57}, {27, 80}}, lineColor={186, 98, 20}, lineThickness=0.5, fillColor={253, 226, 196},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-33, -26}, {-25, -18}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-56, 39}, {-48, 47}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{11, 64}, {19, 72}}, lineColor={186, 98, 20}, fillColor={186, 98, 20},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
An arm on a pedestal that is bolted to the floor. A robot model may continue the icon above y = 100, for the connectors of its
drives; the name stands below.
</p>
</html>"));
end StationaryRobot;
