model A
  B a annotation (Placement(transformation(extent={{-10, 10}, {10, 30}})));
  B b annotation (Placement(transformation(extent={{40, 10}, {60, 30}})));
  B c annotation (Placement(transformation(extent={{-10, -10}, {10, 10}}, origin={100, 20})));
equation
  connect(a.f, b.f) annotation (Line(points={{10, 20}, {40, 20}}));
  connect(b.f, c.f) annotation (Line(points={{60, 20}, {90, 20}}));
end A;
