model A
  C c;
  B b(x={1, 2}, y=3) "d" annotation (Placement(transformation(extent={{-1, 2}, {3, 4}})));

equation
  connect(b, a) annotation (Line(points={{1, 2}, {3, 4}}));

end A;
