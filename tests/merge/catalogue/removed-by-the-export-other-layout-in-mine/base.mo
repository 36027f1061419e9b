model A
  Real a;
  B b annotation (Placement(x = 1));
end A;
