model A
  B a annotation (Placement(transformation(extent={{-10, 10}, {10, 30}})));
  B b annotation (Placement(transformation(extent={{40, 10}, {60, 30}})));
  B m annotation (Placement(transformation(extent={{-10, 80}, {10, 100}})));
  B c annotation (Placement(transformation(extent={{90, 10}, {110, 30}})));
equation
  connect(m.f, a.f) annotation (Line(points={{0, 90}, {0, 0}}));
  connect(a.f, b.f) annotation (Line(points={{10, 20}, {40, 20}}));
  connect(b.f, c.f) annotation (Line(points={{60, 20}, {90, 20}}));
end A;
