model A
  B a annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));
  B b annotation (Placement(transformation(extent={{40, -10}, {60, 10}})));
equation
  connect(a.f, b.f) annotation (Line(points={{10, 0}, {40, 0}}));
end A;
