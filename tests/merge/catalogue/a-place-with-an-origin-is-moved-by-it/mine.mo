model A
  B a annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));
  B b annotation (Placement(transformation(extent={{40, 50}, {60, 70}})));
equation
  connect(a.f, b.f) annotation (Line(points={{10, 0}, {25, 0}, {25, 60}, {40, 60}}));
end A;
