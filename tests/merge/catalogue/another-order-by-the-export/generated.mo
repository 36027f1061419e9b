model A
  Real b;
  Real a;
end A;
