model A
  F a annotation (Placement(transformation(x = 20), iconTransformation(extent={{0, 0}, {9, 9}})));
  F c annotation (Placement(transformation(x = 40), iconTransformation(extent={{-20, 20}, {-11, 29}})));
  F b annotation (Placement(transformation(x = 60), iconTransformation(extent={{0, 20}, {9, 29}})));
equation
  annotation (Icon(coordinateSystem(extent={{0, 0}, {1, 100}}), graphics={Text(extent={{0, 7}, {9, 16}}, textString="a"), Text(extent={{0, 20}, {9, 29}}, textString="label of b"), Text(extent={{0, 40}, {9, 49}}, textString="c")}));
end A;
