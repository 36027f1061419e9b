model A
  F a annotation (Placement(transformation(x = 20), iconTransformation(extent={{0, 20}, {9, 29}})));
  F c annotation (Placement(transformation(x = 40), iconTransformation(extent={{0, 40}, {9, 49}})));
  F b annotation (Placement(transformation(x = 60), iconTransformation(extent={{0, 60}, {9, 69}})));
equation
  annotation (Icon(coordinateSystem(extent={{0, 0}, {1, 150}}), graphics={Text(extent={{0, 20}, {9, 29}}, textString="a"), Text(extent={{0, 40}, {9, 49}}, textString="c"), Text(extent={{0, 60}, {9, 69}}, textString="b")}));
end A;
