within UrdfSync.Icons;

partial model PlanarJoint "Icon of planar joints"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-130, -110}, {130, -70}}, textColor={0, 0, 255}, textString="%name"),
        Rectangle(extent={{-100, -12}, {-60, 12}}, lineColor={90, 90, 90}, fillColor={224, 224, 224},
            fillPattern=FillPattern.Solid),
        Polygon(points={{-96, -54}, {52, -54}, {96, 54}, {-52, 54}, {-96, -54}}, lineColor={105, 70, 150},
            lineThickness=0.5, fillColor={228, 217, 243}, fillPattern=FillPattern.Solid),
        Polygon(points={{36, -39}, {20, -30}, {20, -36}, {-72, -36}, {-72, -42}, {20, -42}, {20, -48}, {36, -39}},
            pattern=LinePattern.None, fillColor={105, 70, 150}, fillPattern=FillPattern.Solid),
        Polygon(points={{-37, 46}, {-52, 35}, {-46, 32}, {-74, -38}, {-70, -40}, {-41, 30}, {-35, 28}, {-37, 46}},
            pattern=LinePattern.None, fillColor={105, 70, 150}, fillPattern=FillPattern.Solid),
        Rectangle(extent={{8, -12}, {100, 12}}, lineColor={105, 70, 150}, fillColor={228, 217, 243},
            fillPattern=FillPattern.Solid),
        Polygon(points={{29, 27}, {24, 30}, {19, 33}, {13, 34}, {7, 34}, {1, 34}, {-5, 32}, {-10, 29}, {-15, 26},
            {-19, 21}, {-22, 16}, {-25, 11}, {-26, 5}, {-26, -1}, {-26, -7}, {-24, -13}, {-21, -18}, {-18, -23},
            {-13, -27}, {-8, -30}, {-3, -33}, {3, -34}, {9, -34}, {9, -41}, {24, -28}, {9, -23}, {9, -29}, {4, -29},
            {-1, -28}, {-6, -26}, {-10, -23}, {-14, -20}, {-17, -15}, {-19, -11}, {-21, -6}, {-21, -1}, {-21, 4},
            {-20, 9}, {-18, 14}, {-15, 18}, {-12, 22}, {-8, 25}, {-3, 27}, {2, 29}, {7, 29}, {12, 29}, {17, 28},
            {22, 26}, {26, 23}, {29, 27}}, pattern=LinePattern.None, fillColor={105, 70, 150},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{-8, -16}, {24, 16}}, lineColor={105, 70, 150}, lineThickness=0.5, fillColor={228, 217, 243},
            fillPattern=FillPattern.Solid),
        Ellipse(extent={{3, -5}, {13, 5}}, lineColor={105, 70, 150}, fillColor={105, 70, 150},
            fillPattern=FillPattern.Solid)}),
    Documentation(info="<html>
<p>
A puck on a plate: it slides both ways and turns about the normal of the plate.
</p>
</html>"));
end PlanarJoint;
