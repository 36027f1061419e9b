model A
  Real a;
  B b annotation (Placement(x = 2));
end A;
