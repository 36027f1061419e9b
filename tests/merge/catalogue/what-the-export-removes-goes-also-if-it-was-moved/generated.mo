model A
  B a annotation (Placement(transformation(extent={{-10, -10}, {10, 10}})));
equation
end A;
