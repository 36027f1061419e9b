model A
  Real m annotation (Placement(x = 1));
end A;
