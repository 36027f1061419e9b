model A
  B a annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));
  B b;
  B c annotation (Placement(transformation(extent={{90, -10}, {110, 10}})));
equation
  connect(a.f, b.f) annotation (Line(points={{10, 0}, {40, 0}}));
  connect(b.f, c.f) annotation (Line(points={{60, 20}, {75, 20}, {75, 0}, {90, 0}}));
  annotation (Diagram(coordinateSystem(extent={{0, 0}, {1, 1}})));
end A;
