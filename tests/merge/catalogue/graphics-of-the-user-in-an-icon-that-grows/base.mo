model A
  F a annotation (Placement(transformation(x = 0), iconTransformation(extent={{0, 0}, {9, 9}})));
  F b annotation (Placement(transformation(x = 20), iconTransformation(extent={{0, 20}, {9, 29}})));
equation
  annotation (Icon(coordinateSystem(extent={{0, 0}, {1, 100}}), graphics={Text(extent={{0, 0}, {9, 9}}, textString="a"), Text(extent={{0, 20}, {9, 29}}, textString="b")}));
end A;
