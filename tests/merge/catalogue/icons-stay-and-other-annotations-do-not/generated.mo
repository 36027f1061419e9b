model A
  B a annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));
equation
  connect(a.f, b.f) annotation (Line(points={{10, 0}, {40, 0}}));
  annotation (Icon(graphics={Line(points={{0, 0}, {3, 1}})}), Documentation(info="b"));
end A;
