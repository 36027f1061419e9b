model A
  F a annotation (Placement(transformation(x = 0), iconTransformation(extent={{0, 20}, {9, 29}})));
  F b annotation (Placement(transformation(x = 20), iconTransformation(extent={{0, 60}, {9, 69}})));
equation
  annotation (Icon(coordinateSystem(extent={{0, 0}, {1, 150}}), graphics={Text(extent={{0, 7}, {9, 16}}, textString="a"), Text(extent={{0, 60}, {9, 69}}, textString="b")}));
end A;
