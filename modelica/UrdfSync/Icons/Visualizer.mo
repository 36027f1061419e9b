within UrdfSync.Icons;

partial model Visualizer "Icon of shapes in the animation"
  annotation (
    Icon(
      coordinateSystem(extent={{-100, -100}, {100, 100}}),
      graphics={
        Text(extent={{-150, 70}, {150, 110}}, textColor={0, 0, 255}, textString="%name"),
        Line(points={{-100, 0}, {-20, 0}}, color={90, 90, 90}, thickness=0.5)}),
    Documentation(info="<html>
<p>
The name, and a line from the frame to the shape, which each visualizer draws over its end.
</p>
</html>"));
end Visualizer;
