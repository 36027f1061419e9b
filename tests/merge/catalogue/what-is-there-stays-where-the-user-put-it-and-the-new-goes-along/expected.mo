model A
  B a annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));
  B b annotation (Placement(transformation(extent={{40, 50}, {60, 70}})));
  B c annotation (Placement(transformation(extent={{90, 50}, {110, 70}})));
equation
  connect(a.f, b.f) annotation (Line(points={{10, 0}, {25, 0}, {25, 60}, {40, 60}}));
  connect(b.f, c.f) annotation (Line(points={{60, 60}, {90, 60}}));
end A;
