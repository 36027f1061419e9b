model A
  C c(z = 1);
  B b(x = {1, 2}, y = 4) "d" annotation (Placement(transformation(extent = {{-1, 2}, {3, 4}})));

equation
  connect(b, a) annotation (Line(points = {{1, 2}, {3, 4}}));
  x = 1;
end A;
