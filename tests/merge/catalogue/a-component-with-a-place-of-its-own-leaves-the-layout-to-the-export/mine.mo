model A
  B a annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));
  B b annotation (Placement(transformation(extent={{40, -10}, {60, 10}})));
  B m annotation (Placement(transformation(extent={{-10, 80}, {10, 100}})));
equation
  connect(m.f, a.f) annotation (Line(points={{0, 90}, {0, 0}}));
  connect(a.f, b.f) annotation (Line(points={{10, 0}, {40, 0}}));
end A;
